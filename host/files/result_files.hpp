// SPDX-License-Identifier: GPL-3.0-or-later
/// \file result_files.hpp  Writes result files so that they stay intact if a run fails.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace macadam {

/// Name of the file with the scene of a run whose command set values of the scene.
inline constexpr const char* changed_scene_file = "scene_as_run.toml";

/// Writes one file under another name and renames it, so that a reader finds either the old bytes or the new ones. A
/// file that could not be written completely is removed. If `to_disk` is true, also waits until the file is on the
/// disk; then even a power failure leaves either the old or the new file. \throws RunError.
void write_whole(const std::filesystem::path& file, std::string_view bytes, bool to_disk = false);

/// Returns all bytes of a file. \throws RunError if it cannot be read, std::bad_alloc if there is too little memory.
std::string read_whole(const std::filesystem::path& file);

/// Returns a name as a field of a CSV file: quoted where RFC 4180 requires it.
std::string csv_field(const std::string& name);

/// A file that is open for writing. The class uses system calls, because a C++ stream reports neither why a write fails
/// nor whether the data are on the disk. A function that fails returns `false`, with the reason in errno.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile() { close(); }
  bool write(std::string_view bytes) const;
  bool sync() const;             ///< waits until the data are on the disk
  bool cut(off_t length) const;  ///< shortens the file to this many bytes; the next write continues there
  bool close();                  ///< some file systems report only here that a write has failed

 private:
  int file_;
};

/// A table that grows during a run. Each line is written to the file when it is added.
class LineWriter {
 public:
  /// Starts a new file with `head`, its first lines. \throws RunError if the file cannot be opened.
  LineWriter(const std::filesystem::path& file, std::string_view head);
  /// Appends one line, which is given without its line end. If the disk does not take the whole line, the part that was
  /// written is removed from the file. \throws RunError.
  void add(std::string_view line);
  /// Closes the file after the last line. \throws RunError.
  void close();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  OutputFile out_;
  off_t length_ = 0;
};

/// Replaces several files of one folder together. The new files are written to a subfolder first. Older files with the
/// same names stay as they are until give_names() renames the new files.
class FilesTogether {
 public:
  /// Makes the subfolder `.part` for the new files. \throws RunError.
  explicit FilesTogether(const std::filesystem::path& folder);
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;
  /// Removes the new files that were not renamed.
  ~FilesTogether();
  /// Returns the path to which the file of this name must be written. \throws RunError.
  std::filesystem::path place_of(const std::string& name);
  /// Moves the new files to their final names, in the order of the calls of place_of(). \throws RunError.
  void give_names();

 private:
  std::filesystem::path folder_, place_;
  std::vector<std::string> names_;
};

}  // namespace macadam
