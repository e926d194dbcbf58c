// SPDX-License-Identifier: GPL-3.0-or-later
/// \file recorded_files.hpp  Reads files of results into short lists of numbers and text, which tests compare with
/// recorded ones.
#pragma once

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/hdf5_numbers.hpp"
#include "macadam/ct.hpp"
#include "tests/support/png_picture.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test::recorded {

/// The numbers of a file in their order, and the text around them with '#' in place of each number.
struct Content {
  std::string text;
  std::vector<double> numbers;
};
/// Contents by the names of columns, keys and arrays.
using Contents = std::map<std::string, Content>;

/// Appends text to `to`. A number begins where no letter, digit, point or underscore stands before it.
inline void add(Content& to, const std::string& text) {
  const auto part_of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; };
  for (std::size_t at = 0; at < text.size();) {
    const bool first = at == 0 || !part_of_word(text[at - 1]);
    const char* const begin = text.c_str() + at;
    const bool digits = std::isdigit(static_cast<unsigned char>(*begin)) ||
                        ((*begin == '-' || *begin == '+') && std::isdigit(static_cast<unsigned char>(begin[1])));
    char* end = nullptr;
    const double number = first && digits ? std::strtod(begin, &end) : 0;
    if (end && end != begin) {
      to.numbers.push_back(number);
      to.text += '#';
      at += static_cast<std::size_t>(end - begin);
    } else {
      to.text += text[at++];
    }
  }
}

/// Adds the lines of a text: one entry per line for at most 100 lines, otherwise one entry for the whole text.
inline void add_lines(Contents& to, const std::string& text, const std::string& name) {
  const auto number = std::count(text.begin(), text.end(), '\n');
  std::istringstream lines(text);
  int at = 0;
  for (std::string line; std::getline(lines, line);)
    add(to[number <= 100 ? fmt::format("{} {:02}", name, ++at) : name], line + '\n');
}

/// Adds the columns of a CSV table; lines that begin with # go into a separate entry.
inline void add_table(Contents& to, const std::string& text) {
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) {
      add(to["comments"], line + '\n');
      continue;
    }
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    if (names.empty())
      names = fields;
    else
      for (std::size_t i = 0; i < fields.size(); ++i) add(to[i < names.size() ? names[i] : "beyond"], fields[i] + ' ');
  }
}

/// Adds each value of a JSON document to the entry of its path, for example `solver.steps`. All elements of an array
/// have the path of the array, so its numbers form one list.
inline void add_json(Contents& to, const nlohmann::json& json, const std::string& path) {
  if (json.is_object())
    for (const auto& [key, value] : json.items()) add_json(to, value, path.empty() ? key : path + '.' + key);
  else if (json.is_array() && json.empty())
    add(to[path], "[] ");
  else if (json.is_array())
    for (const auto& value : json) add_json(to, value, path);
  else if (json.is_string())
    add(to[path], json.get<std::string>() + ' ');
  else
    add(to[path], json.dump() + ' ');
}

/// Adds the numeric arrays of an HDF5 file; texts and attributes are left out.
inline void add_arrays(Contents& to, const H5::Group& group, const std::string& path) {
  for (hsize_t i = 0; i < group.getNumObjs(); ++i) {
    const std::string name = group.getObjnameByIdx(i), all = path.empty() ? name : path + '/' + name;
    if (group.childObjType(name) == H5O_TYPE_GROUP) {
      add_arrays(to, group.openGroup(name), all);
      continue;
    }
    const H5::DataSet set = group.openDataSet(name);
    if (set.getTypeClass() != H5T_INTEGER && set.getTypeClass() != H5T_FLOAT) continue;
    std::vector<double>& out = to[all].numbers;
    out.resize(static_cast<std::size_t>(set.getSpace().getSimpleExtentNpoints()));
    if (!out.empty()) set.read(out.data(), H5::PredType::NATIVE_DOUBLE);
  }
}

/// Adds the content of a file, read according to its extension.
inline void add_file(Contents& to, const fs::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".h5" || ending == ".vtkhdf") return add_arrays(to, open_hdf5(path), "");
  if (ending == ".png") {
    for (const std::uint8_t byte : read_png(path).bytes) to["pixels"].numbers.push_back(byte);
    return;
  }
  const std::string text = read(path);
  if (ending == ".vtp" || ending == ".pvd") {  // XML; a .vtp file has binary arrays after it
    to["bits"].text = text;
    return;
  }
  if (ending == ".csv") return add_table(to, text);
  if (ending == ".json") return add_json(to, nlohmann::json::parse(text), "");
#ifdef MACADAM_HAS_CT
  if (ending == ".mha") {
    const Image<float> image = read_image<float>(path);
    for (const float voxel : image.voxels) to["voxels"].numbers.push_back(voxel);
    return;
  }
#endif
  add_lines(to, text, "line");
}

/// Returns the FNV-1a hash, which is the same on every machine, unlike std::hash.
inline std::uint64_t hash(const std::string& text) {
  std::uint64_t out = 14695981039346656037u;
  for (const char c : text) out = (out ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return out;
}

/// Returns the form in which a content is recorded. Up to 12 numbers are kept as they are. For a longer list, the
/// count, the sum, the sum with increasing weights and the sum of absolute values are kept. A long text is kept as its
/// hash.
inline nlohmann::ordered_json digest(const Content& content) {
  nlohmann::ordered_json out;
  std::string bare;
  for (const char c : content.text)
    if (c != '#' && c != ' ' && c != '\n') bare += c;
  if (content.text.size() <= 2000 && !bare.empty()) out["text"] = content.text;
  if (content.text.size() > 2000) out["hash"] = fmt::format("{:016x}", hash(content.text));
  const auto& x = content.numbers;
  if (x.size() <= 12) {
    if (!x.empty()) out["numbers"] = x;
    return out;
  }
  double sum = 0, moment = 0, size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += x[i];
    moment += x[i] * (static_cast<double>(i) + 0.5) / static_cast<double>(x.size());
    size += std::abs(x[i]);
  }
  out["count"] = x.size();
  out["sums"] = {sum, moment, size};
  return out;
}

}  // namespace macadam::test::recorded
