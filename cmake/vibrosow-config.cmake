# find_package(vibrosow): the target vibrosow::vibrosow. Its archives need the libraries they were built with.
include(CMakeFindDependencyMacro)
foreach(library box2d Boost cereal Eigen3 fmt TBB nlohmann_json tomlplusplus)
  find_dependency(${library})
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/vibrosow-targets.cmake)
