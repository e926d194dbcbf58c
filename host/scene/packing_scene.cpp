// SPDX-License-Identifier: GPL-3.0-or-later
// packing_scene.cpp  Writes the file and the dimensions of a packing into a new scene.
#include "host/scene/packing_scene.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "host/scene/new_scene.hpp"
#include "host/scene/text_edits.hpp"

namespace macadam::scene {
namespace {

void replace_line(std::string& text, const std::string& line, const std::string& by) {
  const std::size_t at = text.find("\n" + line + "\n");
  if (at == std::string::npos) throw std::logic_error("a new scene has no line " + line);
  text.replace(at + 1, line.size(), by);
}

}  // namespace

std::string packing_scene(const std::string& file, const Domain& domain, const std::string& test, ContactRule rule,
                          bool cracks) {
  std::string text = new_scene(NewKind::packing, test, rule, cracks);
  const Vec3d& size = domain.size;
  replace_line(text, R"(file = "specimen.csv")", "file = " + in_toml_quotes(file));
  replace_line(text, R"(box = ["20 mm", "20 mm", "30 mm"])",
               domain.is_box()
                   ? fmt::format("box = [{}, {}, {}]", size.x, size.y, size.z)
                   : fmt::format("domain = \"{}\"\ndiameter = {}\nheight = {}", domain.name(), size.x, size.z));
  return text;
}

}  // namespace macadam::scene
