// SPDX-License-Identifier: GPL-3.0-or-later
// particle_files.cpp  Writes particles as LAMMPS data, LAMMPS dump and extended XYZ.
#include "host/files/particle_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "host/files/result_files.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

/// Text of a file while it is made.
class Text {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> text, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), text, std::forward<Args>(args)...);
  }
  std::string_view view() const { return {buffer_.data(), buffer_.size()}; }

 private:
  fmt::memory_buffer buffer_;
};

int lammps_type(Phase phase) { return phase == Phase::aggregate ? 1 : 2; }
const char* name_of(Phase phase) { return phase == Phase::aggregate ? "aggregate" : "mastic"; }
bool is_bond(const Contact& contact) { return contact.b >= 0; }

void add_data(Text& text, const Specimen& p, const ContactNetwork& network, const PhaseDensities& density) {
  const Vec3d& size = p.box.size;
  text.add("Macadam {}: SI units; atom types 1 aggregate, 2 mastic; bond types", version());
  for (int pair = 0; pair < particle_pair_types; ++pair)
    text.add("{} {} {}", pair > 0 ? "," : "", pair + 1, to_string(static_cast<PairType>(pair)));
  const auto bonds = std::count_if(network.contacts.begin(), network.contacts.end(), is_bond);
  text.add("\n\n{} atoms\n{} bonds\n2 atom types\n{} bond types\n\n", p.size(), bonds, particle_pair_types);
  text.add("0 {} xlo xhi\n0 {} ylo yhi\n0 {} zlo zhi\n\nAtoms # bpm/sphere\n\n", size.x, size.y, size.z);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double rho = p.phase[i] == Phase::aggregate ? density.aggregate : density.mastic;
    text.add("{} {} {} {} {} {} {} {}\n", i + 1, p.body[i] + 1, lammps_type(p.phase[i]), 2 * p.radius[i], rho,
             p.centre[i].x, p.centre[i].y, p.centre[i].z);
  }
  if (bonds == 0) return;  // an empty section is an error for LAMMPS
  text.add("\nBonds\n\n");
  std::size_t number = 0;
  for (const Contact& contact : network.contacts)
    if (is_bond(contact))
      text.add("{} {} {} {}\n", ++number, static_cast<int>(contact.pair) + 1, contact.a + 1, contact.b + 1);
}

void add_dump(Text& text, const Specimen& p) {
  const Vec3d& size = p.box.size;
  text.add("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n0 {}\n0 {}\n0 {}\n", p.size(),
           size.x, size.y, size.z);
  text.add("ITEM: ATOMS id mol type x y z radius\n");
  for (std::size_t i = 0; i < p.size(); ++i)
    text.add("{} {} {} {} {} {} {}\n", i + 1, p.body[i] + 1, lammps_type(p.phase[i]), p.centre[i].x, p.centre[i].y,
             p.centre[i].z, p.radius[i]);
}

void add_xyz(Text& text, const Specimen& p) {
  const Vec3d& size = p.box.size;
  text.add(
      "{}\nLattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"0 0 0\" pbc=\"F F F\" "
      "Properties=species:S:1:pos:R:3:radius:R:1:id:I:1:molecule:I:1\n",
      p.size(), size.x, size.y, size.z);
  for (std::size_t i = 0; i < p.size(); ++i)
    text.add("{} {} {} {} {} {} {}\n", name_of(p.phase[i]), p.centre[i].x, p.centre[i].y, p.centre[i].z, p.radius[i],
             i + 1, p.body[i] + 1);
}

}  // namespace

std::string particle_file_name(ParticleFormat format) {
  return format == ParticleFormat::data   ? "specimen.data"
         : format == ParticleFormat::dump ? "specimen.dump"
                                          : "specimen.xyz";
}

void write_particles(const std::filesystem::path& file, ParticleFormat format, const Specimen& specimen,
                     const ContactNetwork& network, const PhaseDensities& density) {
  Text text;
  if (format == ParticleFormat::data) add_data(text, specimen, network, density);
  if (format == ParticleFormat::dump) add_dump(text, specimen);
  if (format == ParticleFormat::xyz) add_xyz(text, specimen);
  write_whole(file, text.view());
}

}  // namespace macadam
