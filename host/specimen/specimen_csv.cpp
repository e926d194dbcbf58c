// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen_csv.cpp  The specimen's file: `id,x,y,z,radius,phase,body`, plain or gzip.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>
#include <memory>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "host/results/files.hpp"
#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"
#include "macadam/specimen.hpp"

namespace macadam {
namespace {

constexpr std::string_view header = "id,x,y,z,radius,phase,body";
constexpr std::size_t columns = 7;

/// Text from a file as a message may show it: quoted, printable, not too long.
std::string quoted(std::string_view text) {
  std::string out(text.substr(0, 60));
  for (char& c : out)
    if (c < ' ' || c > '~') c = '?';
  return "\"" + out + (text.size() > 60 ? "…\"" : "\"");
}

std::string read_all(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw InputError(name, 0, "specimen", "a directory", "a CSV file");
  errno = 0;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(name.c_str(), "rb"), gzclose_r);
  if (!in) throw InputError(name, 0, "specimen", std::strerror(errno), "a readable file");
  std::string text;
  std::array<char, 1 << 16> buffer;
  int got = 0;
  while ((got = gzread(in.get(), buffer.data(), buffer.size())) > 0) text.append(buffer.data(), got);
  // A file cut off in mid-stream reads to its end and only then shows an error code.
  int code = Z_OK;
  const std::string reason = gzerror(in.get(), &code);
  if (code != Z_OK && code != Z_STREAM_END)
    throw InputError(name, 0, "specimen", code == Z_ERRNO ? std::strerror(errno) : reason, "a whole readable file");
  return text;
}

/// Reads one file: knows the name and the line at hand, which every message needs.
class CsvReader {
 public:
  CsvReader(const std::filesystem::path& file, const Box& box) : name_(file.string()), text_(read_all(file)) {
    specimen_.box = box;
  }

  Specimen read() {
    std::string_view rest = text_;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // the byte-order mark that spreadsheets write
    while (!rest.empty() && (rest.back() == '\n' || rest.back() == '\r')) rest.remove_suffix(1);
    if (rest.empty()) throw InputError(name_, 0, "specimen", "an empty file", "the header " + std::string(header));
    const std::string_view first = next_line(rest);
    if (first != header) fail("header", quoted(first), quoted(header));
    while (!rest.empty()) record(next_line(rest));
    if (const auto fault = find_fault(specimen_)) {
      if (fault->particle < 0) throw InputError(name_, 0, fault->what, fault->found, fault->expected);
      line_ = static_cast<int>(fault->particle) + 2;  // one record a line, after the header
      fail("particle " + std::to_string(fault->particle) + ": " + fault->what, fault->found, fault->expected);
    }
    return std::move(specimen_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& found, const std::string& expected) const {
    throw InputError(name_, line_, what, found, expected);
  }

  std::string_view next_line(std::string_view& rest) {
    ++line_;
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  template <class T>
  T number(std::string_view field, const char* column, const char* expected) const {
    T value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    bool good = error == std::errc{} && end == field.data() + field.size();
    if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
    if (!good) fail(std::string("column ") + column, quoted(field), expected);
    return value;
  }

  void record(std::string_view line) {
    std::array<std::string_view, columns> field;
    const std::size_t found = 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
    if (found != columns)
      fail("columns", std::to_string(found) + " in " + quoted(line),
           std::to_string(columns) + " (" + std::string(header) + ")");
    for (std::string_view& f : field) {
      const std::size_t end = std::min(line.find(','), line.size());
      f = line.substr(0, end);
      line.remove_prefix(std::min(end + 1, line.size()));
    }
    constexpr const char* finite = "a finite number";
    const auto id = number<std::int64_t>(field[0], "id", "an integer of 0 or more");
    if (id < 0) fail("column id", quoted(field[0]), "an integer of 0 or more");
    if (const auto [earlier, is_new] = line_of_id_.try_emplace(id, line_); !is_new)
      fail("column id", quoted(field[0]) + ", that of line " + std::to_string(earlier->second), "a number of its own");
    specimen_.centre.push_back({number<double>(field[1], "x", finite), number<double>(field[2], "y", finite),
                                number<double>(field[3], "z", finite)});
    specimen_.radius.push_back(number<double>(field[4], "radius", "a finite positive number"));
    if (field[5] == to_string(Phase::aggregate))
      specimen_.phase.push_back(Phase::aggregate);
    else if (field[5] == to_string(Phase::mastic))
      specimen_.phase.push_back(Phase::mastic);
    else
      fail("column phase", quoted(field[5]), "aggregate or mastic");
    specimen_.body.push_back(number<std::int32_t>(field[6], "body", "an integer of -1 or more"));
  }

  std::string name_, text_;
  int line_ = 0;
  Specimen specimen_;
  std::unordered_map<std::int64_t, int> line_of_id_;
};

}  // namespace

Specimen read_specimen_csv(const std::filesystem::path& file, const Box& box) { return CsvReader(file, box).read(); }

void write_specimen_csv(const std::filesystem::path& file, const Specimen& specimen) {
  std::ostringstream out;
  out << header << '\n';
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vec3d& c = specimen.centre[i];
    out << i << ',' << shown(c.x) << ',' << shown(c.y) << ',' << shown(c.z) << ',' << shown(specimen.radius[i]) << ','
        << to_string(specimen.phase[i]) << ',' << specimen.body[i] << '\n';
  }
  write_whole(file, out.str());  // it may be the very file that the scene was read from
}

}  // namespace macadam
