// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen_csv.cpp  Reads and writes specimen files: `id,x,y,z,radius,phase,body`, plain text or gzip.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "host/base/in_quotes.hpp"
#include "host/files/result_files.hpp"
#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"
#include "macadam/specimen.hpp"

namespace macadam {
namespace {

constexpr std::string_view header = "id,x,y,z,radius,phase,body";
constexpr std::size_t columns = 7;

/// Reads the lines of a text or gzip file one by one. Only one line is in memory, whatever the size of the unpacked
/// file.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& file) : name_(file.string()) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) fail("a directory", "a CSV file");
    errno = 0;
    in_.reset(gzopen(name_.c_str(), "rb"));
    if (!in_ && (errno == ENOMEM || errno == 0)) throw std::bad_alloc();  // zlib reports lack of memory in this way
    if (!in_) fail(std::strerror(errno), "a readable file");
  }

  /// Reads the next line, without its end; false after the last one.
  bool next(std::string& line) {
    line.clear();
    while (true) {
      if (at_ == got_ && !fill()) break;
      const auto* begin = buffer_.data() + at_;
      const auto* end = static_cast<const char*>(std::memchr(begin, '\n', static_cast<std::size_t>(got_ - at_)));
      const auto length = end ? end - begin : got_ - at_;
      if (line.empty()) ++number_;
      line.append(begin, static_cast<std::size_t>(length));
      if (line.size() > longest)
        throw InputError(name_, number_, "line", "more than " + std::to_string(longest) + " bytes",
                         "a record of at most " + std::to_string(longest) + " bytes");
      at_ += static_cast<int>(length) + (end ? 1 : 0);
      if (!end) continue;
      if (line.ends_with('\r')) line.pop_back();
      return true;
    }
    if (line.empty()) return false;
    // A file that is cut off within its last number could be read as a different valid file, so the last line must end
    // with a newline.
    throw InputError(name_, number_, "last line", "no newline at its end",
                     "a newline, because without one the file may be cut off");
  }

  /// Returns the number of the last line, counted from 1.
  int number() const { return number_; }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw InputError(name_, 0, "specimen", found, expected);
  }

  /// Reads the next part of the file into the buffer. Returns false at its end.
  bool fill() {
    at_ = 0;
    got_ = gzread(in_.get(), buffer_.data(), buffer_.size());
    if (got_ > 0) return true;
    // For a file that is cut off, gzread() returns all complete data first and reports the error afterwards.
    int code = Z_OK;
    const std::string reason = gzerror(in_.get(), &code);
    if (code == Z_MEM_ERROR) throw std::bad_alloc();
    if (code != Z_OK && code != Z_STREAM_END)
      fail(code == Z_ERRNO ? std::strerror(errno) : reason, "a complete readable file");
    // gzread() silently ignores data that follow the end of a gzip stream.
    if (!gzdirect(in_.get()) && gzoffset(in_.get()) != static_cast<z_off_t>(std::filesystem::file_size(name_)))
      fail("bytes behind the end of the gzip data", "none");
    got_ = 0;
    return false;
  }

  // Longest line [bytes]. A record of seven numbers has at most a few hundred bytes.
  static constexpr std::size_t longest = 1000;
  std::string name_;
  std::unique_ptr<gzFile_s, int (*)(gzFile)> in_{nullptr, gzclose_r};
  std::array<char, 1 << 16> buffer_;
  int at_ = 0, got_ = 0, number_ = 0;
};

/// Reads one file. Keeps its name and the current line for messages.
class CsvReader {
 public:
  CsvReader(const std::filesystem::path& file, const Domain& box) : lines_(file) {
    specimen_.box = box;
    specimen_.source = file.string();
  }

  Specimen read() {
    std::string line;
    constexpr int most_blank = 1000;
    int blank = 0;  // line number of the first blank line; blank lines are allowed only at the end of the file
    while (lines_.next(line)) {
      if (lines_.number() == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // spreadsheets' byte-order mark
      if (line.empty() && (blank == 0 || lines_.number() - blank < most_blank)) {
        if (blank == 0) blank = lines_.number();
        continue;
      }
      if (blank > 0) throw InputError(specimen_.source, blank, "line", "a blank line", "a record");
      if (specimen_.first_line == 0) {
        if (line != header) fail("header", in_quotes(line), in_quotes(header));
        specimen_.first_line = lines_.number() + 1;  // all lines after the header are records
      } else {
        record(line);
      }
    }
    if (specimen_.first_line == 0)
      throw InputError(specimen_.source, 0, "specimen", "an empty file", "the header " + std::string(header));
    validate(specimen_, specimen_.source);
    return std::move(specimen_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& found, const std::string& expected) const {
    throw InputError(specimen_.source, lines_.number(), what, found, expected);
  }

  /// Parses a field as a number of type T.
  template <class T>
  T number(std::string_view field, const char* column, const char* expected) const {
    T value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    bool good = error == std::errc{} && end == field.data() + field.size();
    if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
    if (!good) fail(std::string("column ") + column, in_quotes(field), expected);
    return value;
  }

  /// Parses one record and appends the particle or void.
  void record(std::string_view line) {
    if (static_cast<std::int64_t>(specimen_.cells()) == most_particles)
      fail("particles", "more than " + std::to_string(most_particles), "at most " + std::to_string(most_particles));
    std::array<std::string_view, columns> field;
    const std::size_t found = 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
    if (found != columns)
      fail("columns", std::to_string(found) + " in " + in_quotes(line),
           std::to_string(columns) + " (" + std::string(header) + ")");
    for (std::string_view& f : field) {
      const std::size_t end = std::min(line.find(','), line.size());
      f = line.substr(0, end);
      line.remove_prefix(std::min(end + 1, line.size()));
    }
    constexpr const char* finite = "a finite number";
    const auto id = number<std::int64_t>(field[0], "id", "an integer of 0 or more");
    if (id < 0) fail("column id", in_quotes(field[0]), "an integer of 0 or more");
    if (const auto [earlier, is_new] = line_of_id_.try_emplace(id, lines_.number()); !is_new)
      fail("column id", in_quotes(field[0]) + ", which is already the id in line " + std::to_string(earlier->second),
           "an id that no other line has");
    const Vec3d centre{number<double>(field[1], "x", finite), number<double>(field[2], "y", finite),
                       number<double>(field[3], "z", finite)};
    const auto radius = number<double>(field[4], "radius", "a finite positive number");
    const auto body = number<std::int32_t>(field[6], "body", "an integer of -1 or more");
    if (field[5] == to_string(Phase::air_void)) {
      if (body != -1) fail("column body of a void", in_quotes(field[6]), "-1");
      specimen_.voids.push_back({centre, radius});
      return;
    }
    if (!specimen_.voids.empty())
      fail("column phase", in_quotes(field[5]) + " after a void", "void, because voids must follow all particles");
    specimen_.centre.push_back(centre);
    specimen_.radius.push_back(radius);
    specimen_.body.push_back(body);
    if (field[5] == to_string(Phase::aggregate))
      specimen_.phase.push_back(Phase::aggregate);
    else if (field[5] == to_string(Phase::mastic))
      specimen_.phase.push_back(Phase::mastic);
    else
      fail("column phase", in_quotes(field[5]), "aggregate, mastic or void");
  }

  Lines lines_;
  Specimen specimen_;
  std::unordered_map<std::int64_t, int> line_of_id_;
};

}  // namespace

Specimen read_specimen_csv(const std::filesystem::path& file, const Domain& box) { return CsvReader(file, box).read(); }

void write_specimen_csv(const std::filesystem::path& file, const Specimen& particles) {
  const Specimen specimen = with_voids_as_cells(particles);
  fmt::memory_buffer text;  // unlike a stream, this buffer throws when memory is exhausted
  const auto to = std::back_inserter(text);
  fmt::format_to(to, "{}\n", header);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vec3d& c = specimen.centre[i];
    fmt::format_to(to, "{},{},{},{},{},{},{}\n", i, shown(c.x), shown(c.y), shown(c.z), shown(specimen.radius[i]),
                   to_string(specimen.phase[i]), specimen.body[i]);
  }
  write_whole(file, fmt::to_string(text));  // `file` may be the file from which the specimen was read
}

}  // namespace macadam
