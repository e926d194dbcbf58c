// SPDX-License-Identifier: GPL-3.0-or-later
// scene_text.cpp  Finds values in the text by the positions that the TOML parser reports. The text is parsed again for
// every change.
#include "host/scene/scene_text.hpp"

#include <fmt/format.h>

#include <array>

#include "host/scene/sections.hpp"
#include "host/scene/text_edits.hpp"
#include "host/scene/toml.hpp"
#include "macadam/error.hpp"

namespace macadam::scene {
namespace {

/// Returns a TOML number that is read back as the same double.
std::string real(double v) {
  const std::string text = fmt::format("{}", v);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

/// Returns the edit that sets one key: its value is replaced if the key is there, otherwise the key is added before the
/// first key of the table.
TextEdit set(const std::string& text, const toml::table& table, const std::string& key, std::string value) {
  if (const toml::node* node = table.get(key)) return replaced(text, *node, std::move(value));
  const auto edit = added(text, table, key, value);
  if (!edit) throw RunError("the key " + key + " cannot be set in a table that has no keys of its own");
  return *edit;
}

/// Returns the edit that sets a value of a law. `name` is a key of its section, or `E_2` for the second entry of `E`.
TextEdit set_value(const std::string& text, const toml::table& section, const std::string& name, double value) {
  const toml::array* entries =
      name.size() > 2 && name[1] == '_' && name[2] != 'm' ? section[name.substr(0, 1)].as_array() : nullptr;
  return entries ? replaced(text, *entries->get(std::stoul(name.substr(2)) - 1), real(value))
                 : set(text, section, name, real(value));
}

}  // namespace

void SceneText::set_contact(PairType pair, const std::string& name, double value) {
  const toml::table root = toml::parse(text_);
  TextEdit edit{0, 0, ""};
  for (const toml::node& node : *root["contacts"].as_array()) {
    const toml::table& section = *node.as_table();
    if (section["pair"].value<std::string>() != to_string(pair)) continue;
    edit = set_value(text_, section, name, value);
  }
  text_ = edit.applied_to(std::move(text_));
}

void SceneText::set_material(Phase phase, const std::string& name, double value) {
  const toml::table root = toml::parse(text_);
  const char* section = phase == Phase::mastic ? "mastic" : "aggregate";
  const TextEdit edit = set_value(text_, *root["materials"][section].as_table(), name, value);
  text_ = edit.applied_to(std::move(text_));
}

void SceneText::set_seed(std::uint64_t seed) {
  const toml::table root = toml::parse(text_);
  const std::uint64_t given = root["specimen"]["seed"].value<std::uint64_t>().value_or(SpecimenSpec{}.seed);
  if (given == seed) return;
  const TextEdit edit = set(text_, *root["specimen"].as_table(), "seed", fmt::format("{}", seed));
  text_ = edit.applied_to(std::move(text_));
}

void SceneText::move(const std::filesystem::path& from, const std::filesystem::path& to) {
  namespace fs = std::filesystem;
  constexpr std::array<const char*, 4> paths{"specimen.file", "specimen.aggregate_file", "specimen.shapes.library",
                                             "materials.mastic.from"};
  const auto whole = [](const fs::path& folder) { return fs::absolute(folder.empty() ? fs::path(".") : folder); };
  // the text is parsed for each edit, because an edit moves the text behind it
  for (const std::string path : paths) {
    const bool shapes = path == "specimen.shapes.library";
    const toml::table root = toml::parse(text_);
    const auto view = root.at_path(path);
    const auto name = view.value<std::string>();
    if (!name || (shapes && shipped_library(*name)) || fs::path(*name).is_absolute()) continue;
    const fs::path moved =
        fs::weakly_canonical(whole(from) / *name).lexically_relative(fs::weakly_canonical(whole(to)));
    // "./" marks the name as the name of a folder, even if a built-in library has the same name
    const TextEdit edit = replaced(text_, *view.node(), in_toml_quotes((shapes ? "./" : "") + moved.string()));
    text_ = edit.applied_to(std::move(text_));
  }
}

}  // namespace macadam::scene
