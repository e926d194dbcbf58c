// SPDX-License-Identifier: GPL-3.0-or-later
// files.cpp  Result files. fmt's "{}" prints the shortest digits that round-trip a double.
#include "host/results/files.hpp"

#include <fmt/format.h>

#include <iterator>

#include "macadam/error.hpp"

namespace macadam {

void make_result_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) {
    throw RunError(folder.string() + ": cannot make the result folder" + (error ? ": " + error.message() : ""));
  }
}

void write_whole(const std::filesystem::path& file, const std::string& text) {
  auto part = file;
  part += ".part";
  {
    std::ofstream out(part, std::ios::binary);
    out << text;
    out.flush();
    if (!out) throw RunError(part.string() + ": cannot be written (disk full, or no permission)");
  }
  std::error_code error;
  std::filesystem::rename(part, file, error);
  if (error) throw RunError(file.string() + ": cannot be replaced: " + error.message());
}

std::string csv_field(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

ResponseWriter::ResponseWriter(const std::filesystem::path& file) : file_(file), out_(file, std::ios::binary) {
  out_ << "frequency_hz,time_s,strain,stress_pa\n" << std::flush;
  if (!out_) throw RunError(file_.string() + ": cannot be written (disk full, or no permission)");
}

void ResponseWriter::add(const ResponseSample& s) {
  out_ << fmt::format("{},{},{},{}\n", s.frequency_hz, s.time_s, s.strain, s.stress_pa) << std::flush;
  if (!out_) throw RunError(file_.string() + ": cannot be written on (disk full?)");
}

void write_contacts_csv(const std::filesystem::path& file, const ContactNetwork& network) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(to, "a,b,pair,area,distance,nx,ny,nz,points\n");
  for (const Contact& c : network.contacts) {
    fmt::format_to(to, "{},{},{},{},{},{},{},{},{}\n", c.a, c.b, to_string(c.pair), c.area, c.distance, c.n.x, c.n.y,
                   c.n.z, c.point_end - c.point_begin);
  }
  write_whole(file, fmt::to_string(text));
}

}  // namespace macadam
