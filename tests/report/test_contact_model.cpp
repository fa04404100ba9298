#include "report/contact_model.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "input/read_scene.hpp"

namespace vibrosow {
namespace {

/// The contact of a tray with these lines in [contact], and what becomes of it as a model.
struct Both {
  Contact written, read;
};

Both both(const std::string& lines) {
  const std::filesystem::path folder = testing::TempDir();
  const auto seeder = [&](const std::string& contact) {
    const auto path = folder / "contact-model-seeder.toml";
    std::ofstream(path)
        << "[seeds.ball]\ndiameter = \"3 mm\"\nmass = \"20 mg\"\n[contact]\n"
        << contact
        << "\n[tray]\nlength = \"10 cm\"\nheight = \"5 cm\"\nfill = { count = 9, packing = \"layers\" }\n[run]\n"
           "duration = \"1 s\"\nmeasure_from = \"0 s\"\n";
    return read_scene(path).contact;
  };
  const Contact written = seeder(lines);
  std::ofstream(folder / "contact-model.toml")
      << contact_model_toml(written, "A \"quoted\" title", {{"friction", "measured"}, {"wall.friction", "C:\\bench"}});
  return {written, seeder("model = \"contact-model.toml\"")};
}

TEST(ContactModel, ReadsBackAsItWas) {
  for (const char* lines : {
           "shell_compression = 3e-5\nfriction = 0.37\nrestitution = 0.51",
           "shell_compression = 3e-5\nfriction = 0.37\nslip_speed = \"7 mm/s\"\nfriction_arm = \"rim\"\nrotation = "
           "false",
           "shell_compression = 3e-5\nfriction = 0.37\nfriction_model = \"spring\"\ntangential_ratio = 0.3\n"
           "rolling = \"spring\"\nrolling_friction = 0.1\nrolling_damping = 0.4\nwall.friction = 0.2",
           "law = \"hertz\"\nyoungs_modulus = \"12 MPa\"\npoisson_ratio = 0.27\nfriction = 0.4\nrolling = "
           "\"constant-torque\"\nrolling_friction = 0.02\nwall.youngs_modulus = \"2000 MPa\"\ncohesion = \"0.02 mN\"\n",
           "law = \"hertz\"\nyoungs_modulus = \"12 MPa\"\ndamping_rate = \"300 1/s\"\ndrag = \"0.1 g/s\"",
       }) {
    const Both contacts = both(lines);
    EXPECT_TRUE(contacts.read == contacts.written) << lines;
  }
}

}  // namespace
}  // namespace vibrosow
