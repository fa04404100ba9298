#include "report/vtk_report.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <new>
#include <string_view>
#include <type_traits>

#include "fields/tray_frame.hpp"
#include "report/base64.hpp"
#include "vessel/vessel_faces.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/wall_points.hpp"

namespace vibrosow {
namespace {

using Vector = std::array<double, 3>;

template <class Value>
void append(std::string& bytes, const Value& value) {
  static_assert(std::endian::native == std::endian::little && std::is_trivially_copyable_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string packed(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
               static_cast<uLong>(bytes.size())) != Z_OK)
    throw std::bad_alloc();
  result.resize(size);
  return result;
}

/// One block: how many, their size, that of a last one that is smaller (0: none), their sizes packed; then the block.
std::string encoded(const std::string& bytes) {
  std::string head;
  if (bytes.empty()) {
    for (int k = 0; k < 3; ++k) append(head, std::uint64_t{0});
    return base64(head);
  }
  const std::string block = packed(bytes);
  for (const std::size_t number : {std::size_t{1}, bytes.size(), std::size_t{0}, block.size()})
    append(head, static_cast<std::uint64_t>(number));
  return base64(head) + base64(block);
}

template <class Value>
constexpr std::size_t components_of = 1;
template <std::size_t count>
constexpr std::size_t components_of<std::array<double, count>> = count;

/// The arrays of one part of a file: its points, its data, its cells.
class Arrays {
 public:
  template <class Value>
  void add(std::string_view name, const std::vector<Value>& values) {
    std::string bytes;
    for (const Value& value : values) append(bytes, value);
    text_ += fmt::format(
        R"(        <DataArray type="{}" Name="{}" NumberOfComponents="{}" format="binary">{}</DataArray>)",
        std::is_same_v<Value, std::int64_t> ? "Int64" : "Float64", name, components_of<Value>, encoded(bytes));
    text_ += '\n';
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Cells of points that follow one another: of each cell how many.
std::string cells(const std::vector<std::int64_t>& sizes) {
  std::vector<std::int64_t> connectivity, offsets;
  std::int64_t end = 0;
  for (const std::int64_t size : sizes) {
    for (std::int64_t k = 0; k < size; ++k) connectivity.push_back(end + k);
    offsets.push_back(end += size);
  }
  Arrays arrays;
  arrays.add("connectivity", connectivity), arrays.add("offsets", offsets);
  return arrays.text();
}

/// `kind`: Verts or Lines.
std::string poly_data(std::string_view kind, const std::vector<std::int64_t>& sizes, const std::vector<Vector>& points,
                      const Arrays& of_points, const Arrays& of_cells) {
  Arrays places;
  places.add("points", points);
  return fmt::format(R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
  <PolyData>
    <Piece NumberOfPoints="{0}" NumberOfVerts="{1}" NumberOfLines="{2}" NumberOfStrips="0" NumberOfPolys="0">
      <PointData>
{3}      </PointData>
      <CellData>
{4}      </CellData>
      <Points>
{5}      </Points>
      <{6}>
{7}      </{6}>
    </Piece>
  </PolyData>
</VTKFile>
)",
                     points.size(), kind == "Verts" ? sizes.size() : 0, kind == "Lines" ? sizes.size() : 0,
                     of_points.text(), of_cells.text(), places.text(), kind, cells(sizes));
}

std::vector<Vector> as_vectors(const std::vector<double>& x, const std::vector<double>& y,
                               const std::vector<double>& z) {
  std::vector<Vector> vectors;
  for (std::size_t i = 0; i < x.size(); ++i) vectors.push_back({x[i], y[i], z.empty() ? 0 : z[i]});
  return vectors;
}

std::vector<std::array<double, 4>> orientations(const Snapshot& bed) {
  std::vector<std::array<double, 4>> result;
  for (std::size_t i = 0; i < bed.size(); ++i) {
    if (!bed.q_w.empty())
      result.push_back({bed.q_w[i], bed.q_x[i], bed.q_y[i], bed.q_z[i]});
    else if (!bed.angle.empty())
      result.push_back({std::cos(0.5 * bed.angle[i]), 0, 0, std::sin(0.5 * bed.angle[i])});
    else
      result.push_back({1, 0, 0, 0});
  }
  return result;
}

std::string grains(const Scene& scene, const Frame& frame) {
  const Snapshot& bed = frame.bed;
  const Snapshot own = in_tray_frame(bed, scene.tray);
  Arrays of_points;
  of_points.add("id", bed.id);
  of_points.add("lot", std::vector<std::int64_t>(bed.lot.begin(), bed.lot.end()));
  of_points.add("radius", bed.radius);
  of_points.add("velocity", as_vectors(bed.vx, bed.vy, bed.vz));
  const std::vector<double> none(bed.size(), 0.0);
  of_points.add("angular_velocity",
                bed.is_3d() ? as_vectors(bed.omega_x, bed.omega_y, bed.omega) : as_vectors(none, none, bed.omega));
  of_points.add("orientation", orientations(bed));
  of_points.add("force", contact_forces(frame));
  of_points.add("place_in_tray", as_vectors(own.x, own.y, own.z));
  return poly_data("Verts", std::vector<std::int64_t>(bed.size(), 1), as_vectors(bed.x, bed.y, bed.z), of_points, {});
}

std::string contacts(const Frame& frame) {
  std::vector<Vector> points, normal, tangential;
  std::vector<std::int64_t> grain, partner;
  std::vector<double> overlap;
  for (const GrainContact& contact : frame.contacts) {
    points.push_back(contact.from), points.push_back(contact.to);
    grain.push_back(contact.grain), partner.push_back(contact.partner);
    normal.push_back(contact.normal_force), tangential.push_back(contact.tangential_force);
    overlap.push_back(contact.overlap);
  }
  Arrays of_cells;
  of_cells.add("grain", grain), of_cells.add("partner", partner);
  of_cells.add("normal_force", normal), of_cells.add("tangential_force", tangential);
  of_cells.add("overlap", overlap);
  return poly_data("Lines", std::vector<std::int64_t>(frame.contacts.size(), 2), points, {}, of_cells);
}

struct Lines {
  std::vector<Vector> points;
  std::vector<std::int64_t> sizes, vessel;

  void add(std::int64_t of, const Vessel& at, const Pose& pose, const std::vector<Eigen::Vector3d>& line) {
    for (const Eigen::Vector3d& own : line) {
      const Eigen::Vector3d lab = point_in_lab(at, pose, own);
      points.push_back({lab.x(), lab.y(), lab.z()});
    }
    sizes.push_back(std::ssize(line)), vessel.push_back(of);
  }
};

void add_walls(std::int64_t number, const Vessel& vessel, Space space, double time, Lines& lines) {
  const Pose pose = vessel_pose(vessel, time);
  const auto is_gone = [time](double opens_at) { return opens_at > 0 && time >= opens_at; };
  if (space == Space::two_dimensional) {
    for (const WallSegment& wall : vessel_walls(vessel)) {
      if (is_gone(wall.opens_at)) continue;
      std::vector<Eigen::Vector3d> line;
      for (const Eigen::Vector2d& lab : wall_points(wall)) line.emplace_back(lab.x(), lab.y(), 0.0);
      lines.add(number, vessel, pose, line);
    }
    return;
  }
  for (const Face& face : vessel_faces(vessel))
    if (!is_gone(face.opens_at))
      for (const auto& line : face_lines(face)) lines.add(number, vessel, pose, line);
}

std::string vessels(const Scene& scene, double time) {
  Lines lines;
  add_walls(0, drawn_once(scene.tray), scene.space, time, lines);
  if (scene.hopper) add_walls(1, drawn_once(*scene.hopper), scene.space, time, lines);
  Arrays of_cells;
  of_cells.add("vessel", lines.vessel);
  return poly_data("Lines", lines.sizes, lines.points, {}, of_cells);
}

std::string file_name(std::string_view what, std::size_t k) {
  return fmt::format("{}_{:03}.vtp", what, k + 1);
}

std::string series(std::string_view what, const std::vector<Frame>& frames) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (std::size_t k = 0; k < frames.size(); ++k)
    text +=
        fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frames[k].bed.time, file_name(what, k));
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace

std::vector<std::array<double, 3>> contact_forces(const Frame& frame) {
  const std::vector<std::int64_t>& ids = frame.bed.id;
  std::vector<Vector> forces(ids.size(), Vector{});
  const auto add = [&](std::int64_t id, const GrainContact& contact, double sign) {
    const auto place = std::ranges::lower_bound(ids, id);
    if (place == ids.end() || *place != id) return;
    Vector& force = forces[static_cast<std::size_t>(place - ids.begin())];
    for (std::size_t k = 0; k < 3; ++k) force[k] += sign * (contact.normal_force[k] + contact.tangential_force[k]);
  };
  for (const GrainContact& contact : frame.contacts) add(contact.grain, contact, 1), add(contact.partner, contact, -1);
  return forces;
}

std::vector<OutputFile> vtk_files(const Scene& scene, const std::vector<Frame>& frames) {
  std::vector<OutputFile> files;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    files.push_back({file_name("grains", k), grains(scene, frames[k])});
    files.push_back({file_name("contacts", k), contacts(frames[k])});
    files.push_back({file_name("vessels", k), vessels(scene, frames[k].bed.time)});
  }
  for (const char* what : {"grains", "contacts", "vessels"})
    files.push_back({fmt::format("{}.pvd", what), series(what, frames)});
  return files;
}

std::vector<FileText> vtk_file_texts() {
  return {
      {"grains.pvd", "with --vtk: the series of grains_NNN.vtp, for ParaView", {}},
      {"grains_NNN.vtp",
       "with --vtk, of each snapshot: its grains as points",
       {{"id", "", "as in grains_NNN.csv"},
        {"lot", "", "its seeds' number in the seeder, from 0"},
        {"radius", "m", "as there"},
        {"velocity", "m/s", "in the lab"},
        {"angular_velocity", "rad/s", "in the lab"},
        {"orientation", "", "quaternion w, x, y, z from a clump's own axes to the lab's"},
        {"force", "N", "of all its contacts"},
        {"place_in_tray", "m", "in the tray's frame, as in grains_NNN.csv; the points themselves are in the lab"}}},
      {"contacts.pvd", "with --vtk: the series of contacts_NNN.vtp", {}},
      {"contacts_NNN.vtp",
       "with --vtk, of each snapshot: its contacts as lines from centre to centre or to the wall, of clumps from those "
       "of the discs or balls that touch",
       {{"grain", "", "id of the grain"},
        {"partner", "", "id of the other; -1: a wall"},
        {"normal_force", "N", "on the grain"},
        {"tangential_force", "N", "on the grain"},
        {"overlap", "m", "of the two"}}},
      {"vessels.pvd", "with --vtk: the series of vessels_NNN.vtp", {}},
      {"vessels_NNN.vtp",
       "with --vtk, of each snapshot: the vessels' walls as lines, in 3D their edges and rims",
       {{"vessel", "", "0: the tray, 1: the hopper"}}}};
}

}  // namespace vibrosow
