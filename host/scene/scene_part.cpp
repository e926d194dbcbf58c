// SPDX-License-Identifier: GPL-3.0-or-later
// scene_part.cpp  Writes a section of a new scene with explanations of its keys.
#include "host/scene/scene_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace macadam::scene {
namespace {

constexpr std::size_t width = 118, comment_column = 36;

/// Breaks a text into lines of at most `width` characters that begin with `before`.
std::string wrapped(const std::string& text, const std::string& before) {
  std::string out, line = before;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (line.size() > before.size() && line.size() + 1 + word.size() > width) out += line + '\n', line = before;
    line += (line.size() > before.size() ? " " : "") + word;
  }
  return out + line + '\n';
}

/// Returns one line of the scene with its comment. The comment is on the same line if both fit into the width,
/// otherwise it is above the line.
std::string line_of(const std::string& line, const std::string& comment) {
  const std::size_t column = std::max(comment_column, line.size() + 2);
  if (column + 2 + comment.size() > width) return wrapped(comment, "# ") + line + '\n';
  return fmt::format("{:<{}}# {}\n", line, column, comment);
}

/// Returns the explanation of a key with its choices and unit. If `with_usual` is true, adds what happens without the
/// key.
std::string comment_of(const KnownKey& key, bool with_usual) {
  std::string text = key.text;
  if (!key.words.choices.empty()) {
    text += ": ";
    for (const std::string& choice : key.words.choices)
      text += (choice == key.words.choices.front() ? "\"" : ", \"") + choice + '"';
  }
  if (key.words.quantity && key.words.quantity != &ratio)
    text += fmt::format(" [{}]", key.words.quantity->units.front().name);
  if (with_usual && !key.usual.empty()) text += "; without it: " + key.usual;
  return text;
}

}  // namespace

std::string written(const std::vector<KnownKey>& keys, const Part& part) {
  std::string chosen;
  for (const Given& given : part.given)
    if (given.key == "kind" || given.key == "law") chosen = given.value.substr(1, given.value.size() - 2);
  std::string out = "\n" + (part.remark.empty() ? "" : wrapped(part.remark, "# ")) + part.title + "\n";
  const auto may = [&](const KnownKey& key) {
    const bool fits = key.chosen.empty() || std::count(key.chosen.begin(), key.chosen.end(), chosen);
    return key.section == part.title && fits;
  };
  for (const Given& given : part.given) {
    const auto known =
        std::find_if(keys.begin(), keys.end(), [&](const KnownKey& key) { return may(key) && key.name == given.key; });
    const std::string line = given.key + " = " + given.value;
    out += known == keys.end() || !part.others ? line + '\n' : line_of(line, comment_of(*known, false));
  }
  if (!part.others) return out;
  for (const KnownKey& key : keys) {
    const auto is_given = [&](const Given& given) { return given.key == key.name; };
    if (!may(key) || key.words.type.starts_with("section") ||
        std::any_of(part.given.begin(), part.given.end(), is_given) ||
        std::count(part.not_these.begin(), part.not_these.end(), key.name))
      continue;
    const bool fixed = key.usual.empty() && !key.words.usual.empty();
    out += line_of(fmt::format("# {} = {}", key.name, fixed ? key.words.usual : "..."), comment_of(key, true));
  }
  return out;
}

}  // namespace macadam::scene
