// Drawings: the bytes as SVG and as DXF.

#include "fuzz/try_bytes.hpp"
#include "input/read_drawing.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

void try_bytes(const std::string& bytes) {
  try {
    read_svg(bytes, "a.svg", {1e-3, 1, 1e-4});
  } catch (const InputError&) {
  }
  try {
    read_dxf(bytes, "a.dxf");
  } catch (const InputError&) {
  }
}

}  // namespace vibrosow
