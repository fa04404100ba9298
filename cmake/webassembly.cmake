# The libraries of the core for a WebAssembly build (scripts/web): headers from the system's folders, one by one, since
# the others there are of another C library; Box2D and SLEEF from their sources, which scripts/web-sources has unpacked into
# VIBROSOW_WEB_SOURCES. Emscripten's C++ library is of LLVM 13 and has no std::ranges algorithms: range-v3 stands in.
enable_language(C)
set(VIBROSOW_WEB_SOURCES "" CACHE PATH "folder with box2d and sleef, unpacked")
set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(folder boost cereal nlohmann fmt range meta concepts std)
  if(NOT EXISTS /usr/include/${folder})
    message(FATAL_ERROR "/usr/include/${folder} is not there")
  endif()
  file(CREATE_LINK /usr/include/${folder} ${headers}/${folder} SYMBOLIC)
endforeach()
find_file(SLEEF_HEADER sleef.h PATHS /usr/include/${CMAKE_HOST_SYSTEM_PROCESSOR}-linux-gnu /usr/include NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
file(CREATE_LINK ${SLEEF_HEADER} ${headers}/sleef.h SYMBOLIC)
foreach(name Boost::headers fmt::fmt cereal::cereal nlohmann_json::nlohmann_json Eigen3::Eigen)
  add_library(${name} INTERFACE IMPORTED)
  target_include_directories(${name} SYSTEM INTERFACE ${headers})
endforeach()
target_include_directories(Eigen3::Eigen SYSTEM INTERFACE /usr/include/eigen3)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)


file(GLOB box2d_sources ${VIBROSOW_WEB_SOURCES}/box2d/src/*/*.cpp)
add_library(box2d STATIC ${box2d_sources})
target_include_directories(box2d SYSTEM PUBLIC ${VIBROSOW_WEB_SOURCES}/box2d/include PRIVATE ${VIBROSOW_WEB_SOURCES}/box2d/src)
target_compile_options(box2d PRIVATE -w -ffp-contract=off)
add_library(box2d::box2d ALIAS box2d)

# Of SLEEF only the doubles in plain C, each file compiled as its own build does: functions that are the same in all
# builds come from both passes.
set(sleef ${VIBROSOW_WEB_SOURCES}/sleef/src)
set(made ${CMAKE_BINARY_DIR}/made-for-sleef)  # not "sleef", which find_library would take for the library
file(MAKE_DIRECTORY ${made})
file(WRITE ${made}/sleef-config.h "")
find_program(HOST_CC NAMES cc gcc clang REQUIRED)
execute_process(COMMAND ${HOST_CC} -I${sleef}/common -I${sleef}/arch ${sleef}/libm/mkrename.c -o ${made}/mkrename COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${made}/mkrename cinz_ 1 1 purec OUTPUT_FILE ${made}/renamepurec_scalar.h COMMAND_ERROR_IS_FATAL ANY)
foreach(pass once twice)
  add_library(sleef_${pass} OBJECT ${sleef}/libm/sleefsimddp.c)
  target_include_directories(sleef_${pass} PRIVATE ${made} ${sleef}/common ${sleef}/arch ${sleef}/libm ${sleef}/../include)
  target_compile_definitions(sleef_${pass} PRIVATE ENABLE_PUREC_SCALAR DORENAME)
  target_compile_options(sleef_${pass} PRIVATE -w -ffp-contract=off -fno-strict-aliasing -fno-math-errno -fno-trapping-math)
endforeach()
target_compile_definitions(sleef_twice PRIVATE DETERMINISTIC=1)
add_library(sleef STATIC ${sleef}/libm/rempitab.c $<TARGET_OBJECTS:sleef_once> $<TARGET_OBJECTS:sleef_twice>)
target_include_directories(sleef PRIVATE ${sleef}/common)
target_compile_options(sleef PRIVATE -w)
set(SLEEF sleef)

# For what comes after. Any browser that knows exceptions of WebAssembly also copies and fills memory in one instruction.
add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-mbulk-memory>
                    $<$<COMPILE_LANGUAGE:CXX>:-include${CMAKE_CURRENT_LIST_DIR}/ranges_for_webassembly.hpp>
                    $<$<COMPILE_LANGUAGE:CXX>:-isystem${headers}>)
