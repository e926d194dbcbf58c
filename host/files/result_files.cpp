// SPDX-License-Identifier: GPL-3.0-or-later
// result_files.cpp  Writes result files. fmt's "{}" prints the shortest digits that round-trip a double.
#include "host/files/result_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <new>
#include <system_error>
#include <utility>

#include "macadam/contact_network.hpp"
#include "macadam/error.hpp"

namespace macadam {

namespace {

std::string reason(int error = errno) { return std::generic_category().message(error); }

/// Waits until the entries of a folder are on the disk. Returns false if the disk fails or is full. Other errors are
/// ignored, because some file systems cannot do this for folders.
bool sync_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return true;
  const int error = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  errno = error;
  return error != EIO && error != ENOSPC && error != EDQUOT;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& file)
    : file_(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {}

bool OutputFile::write(std::string_view bytes) const {
  while (file_ >= 0 && !bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return file_ >= 0;
}

bool OutputFile::sync() const { return ::fsync(file_) == 0; }

bool OutputFile::cut(off_t length) const {
  return ::ftruncate(file_, length) == 0 && ::lseek(file_, length, SEEK_SET) == length;
}

bool OutputFile::close() {
  const int file = std::exchange(file_, -1);
  return file < 0 || ::close(file) == 0;
}

void write_whole(const std::filesystem::path& file, std::string_view bytes, bool to_disk) {
  auto part = file;
  part += ".part";
  OutputFile out(part);
  bool written = out.write(bytes) && (!to_disk || out.sync());
  written = out.close() && written;
  const std::string why = written ? "" : reason();
  std::error_code error;
  if (written) std::filesystem::rename(part, file, error);
  if (!written || error) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);  // part of a file on a full disk would keep the disk full
    throw RunError(file.string() + ": cannot be written: " + (written ? error.message() : why));
  }
  if (to_disk && !sync_folder(file.parent_path())) {
    throw RunError(file.string() +
                   ": the file is written, but its folder could not be synchronised to disk: " + reason());
  }
}

std::string read_whole(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in && errno == ENOMEM) throw std::bad_alloc();
  std::string out(in ? static_cast<std::size_t>(in.tellg()) : 0, '\0');
  if (!in || !in.seekg(0).read(out.data(), std::ssize(out)))
    throw RunError(file.string() + ": cannot be read: " + reason());
  return out;
}

std::string csv_field(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

LineWriter::LineWriter(const std::filesystem::path& file, std::string_view head) : file_(file), out_(file) {
  add(head);
}

void LineWriter::add(std::string_view line) {
  const std::string whole = std::string(line) + '\n';
  if (!out_.write(whole)) fail();
  length_ += std::ssize(whole);
}

void LineWriter::close() {
  if (!out_.close()) fail();
}

void LineWriter::fail() const {
  const std::string why = reason();
  [[maybe_unused]] const bool half_a_line_is_gone = out_.cut(length_);
  throw RunError(file_.string() + ": cannot be written: " + why);
}

FilesTogether::FilesTogether(const std::filesystem::path& folder) : folder_(folder), place_(folder / ".part") {
  std::error_code ignored;
  std::filesystem::remove_all(place_, ignored);  // left behind by a run that was killed
  if (::mkdir(place_.c_str(), 0777) != 0) throw RunError(place_.string() + ": cannot be made: " + reason());
}

FilesTogether::~FilesTogether() {
  std::error_code ignored;
  std::filesystem::remove_all(place_, ignored);
}

std::filesystem::path FilesTogether::place_of(const std::string& name) {
  names_.push_back(name);
  return place_ / name;
}

void FilesTogether::give_names() {
  for (const std::string& name : names_) {
    if (::rename((place_ / name).c_str(), (folder_ / name).c_str()) != 0) {
      throw RunError((folder_ / name).string() + ": cannot be written: " + reason());
    }
  }
}

void write_contacts_csv(const std::filesystem::path& file, const ContactNetwork& network) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  const bool series = has_laws_of_phases(network.rule);
  fmt::format_to(to, "a,b,pair,area,distance,nx,ny,nz,points{}\n", series ? ",length,series" : "");
  for (const Contact& c : network.contacts) {
    fmt::format_to(to, "{},{},{},{},{},{},{},{},{}", c.a, c.b, to_string(c.pair), c.area, c.distance, c.n.x, c.n.y,
                   c.n.z, c.point_end - c.point_begin);
    if (series) fmt::format_to(to, ",{},{}", c.length, c.series);
    fmt::format_to(to, "\n");
  }
  write_whole(file, fmt::to_string(text));
}

}  // namespace macadam
