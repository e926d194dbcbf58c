// SPDX-License-Identifier: GPL-3.0-or-later
// keys_page.cpp  Writes the reference of all keys as Markdown and as JSON.
#include "host/scene/keys_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/scene/known_keys.hpp"

namespace macadam::scene {
namespace {

using json = nlohmann::ordered_json;

bool is_section(const KnownKey& key) { return key.words.type.starts_with("section"); }

/// Returns "[specimen.mastic]" for the key mastic of [specimen].
std::string title_of(const KnownKey& key) {
  const auto begin = key.section.find_first_not_of('['), end = key.section.find(']');
  const std::string outer = key.section.empty() ? "" : key.section.substr(begin, end - begin) + ".";
  return key.words.type == "sections" ? "[[" + outer + key.name + "]]" : "[" + outer + key.name + "]";
}

/// Returns the unit in which a number without a unit is read for this key; empty if the key has no unit.
std::string unit_of(const KnownKey& key) {
  if (!key.words.quantity || key.words.quantity == &ratio) return "";
  return std::string(key.words.quantity->units.front().name);
}

std::string code(const std::string& text) { return "`" + text + "`"; }

/// Escapes characters that Markdown would read as markup; a bar would end the cell of a table.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  for (std::size_t at = 0; (at = text.find('*', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

std::string kind_of_value(const KnownKey& key) {
  if (key.words.choices.empty()) {
    const std::string unit = unit_of(key);
    return key.words.type + (unit.empty() ? "" : " [" + unit + "]");
  }
  std::string choices;
  for (const std::string& choice : key.words.choices)
    choices += (choices.empty() ? "" : ", ") + code('"' + choice + '"');
  return key.words.type == "list" ? "list of " + choices : choices;
}

/// Returns the text of a key in the column "default".
std::string usual_of(const KnownKey& key) {
  if (key.need == Need::required) return "**required**";
  if (!key.usual.empty()) return cell(key.usual);
  return key.words.usual.empty() ? "" : code(key.words.usual);
}

/// Returns the row of a key in the table of its section.
std::string row(const KnownKey& key) {
  std::string text = key.text;
  if (!key.chosen.empty()) text += fmt::format(" ({} {})", key.chooser, fmt::join(key.chosen, ", "));
  if (!key.words.rule.empty() && key.words.rule != "a number") text += "; " + key.words.rule;
  return fmt::format("| {} | {} | {} | {} |\n", code(key.name), cell(kind_of_value(key)), usual_of(key), cell(text));
}

}  // namespace

std::string keys_page() {
  const std::vector<KnownKey> keys = known_keys();
  std::string out =
      "# Every key of a scene\n\n"
      "This page lists the keys that the scene reader knows. `macadam info --keys markdown` prints it. [Scene "
      "files](scene.md)\n"
      "explains the keys and how they act together. A number is in the SI unit given here, or it is text with a unit, "
      "such as\n"
      "`\"12.5 mm\"`. A number without a unit may be text in %.\n";
  for (const KnownKey& section : keys) {
    if (!is_section(section)) continue;
    const std::string title = title_of(section);
    out += fmt::format("\n## `{}`\n\n{}{}", title, static_cast<char>(std::toupper(section.text.front())),
                       cell(section.text.substr(1)));
    out += section.need == Need::required ? ". Required." : fmt::format(". Without it: {}.", section.usual);
    out +=
        "\n\n<!-- made by macadam info --keys markdown; do not edit -->\n\n| key | value | default | meaning |"
        "\n|---|---|---|---|\n";
    for (const KnownKey& key : keys)
      if (key.section == title && !is_section(key)) out += row(key);
  }
  return out;
}

std::string keys_json() {
  json out = json::array();
  for (const KnownKey& key : known_keys()) {
    json one{{"section", key.section},
             {"key", key.name},
             {"required", key.need == Need::required},
             {"type", key.words.type},
             {"unit", unit_of(key)},
             {"allowed", key.words.rule},
             {"choices", key.words.choices},
             {"default", key.words.usual},
             {"without_it", key.usual},
             {"text", key.text}};
    if (!key.chosen.empty()) one["only_with"] = {{key.chooser, key.chosen}};
    out.push_back(one);
  }
  return out.dump(1) + "\n";
}

}  // namespace macadam::scene
