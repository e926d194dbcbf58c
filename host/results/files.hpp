// SPDX-License-Identifier: GPL-3.0-or-later
/// \file files.hpp  Result files that survive a failed run.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "macadam/contact_network.hpp"

namespace macadam {

/// Replaces a file by a rename, so that a reader finds the old bytes or the new; what could not be written whole is
/// removed. `to_disk`: waits until it is there, so that a power failure leaves one of the two as well. \throws
/// RunError.
void write_whole(const std::filesystem::path& file, std::string_view bytes, bool to_disk = false);

/// All bytes of a file. \throws RunError where it cannot be read, std::bad_alloc where memory is the reason.
std::string read_whole(const std::filesystem::path& file);

/// A name as a field of a CSV file: quoted where it has to be (RFC 4180).
std::string csv_field(const std::string& name);

/// A file that is open for writing, in the system's own calls: a stream would not say why it fails, nor whether all is
/// on the disk. What a function cannot do it says by `false`, and why in errno.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile() { close(); }
  bool write(std::string_view bytes) const;
  bool sync() const;
  bool cut(off_t length) const;
  bool close();  ///< some file systems say only here that they could not write

 private:
  int file_;
};

/// A table that grows as a run goes on: every line is written as it is measured.
class LineWriter {
 public:
  /// Begins anew; `head`: its first lines. \throws RunError when the file cannot be opened.
  LineWriter(const std::filesystem::path& file, std::string_view head);
  /// A line without its end. What the disk does not take whole is not in the file. \throws RunError.
  void add(std::string_view line);
  /// After the last line. \throws RunError.
  void close();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  OutputFile out_;
  off_t length_ = 0;
};

/// Files of a folder that take their names together: until all of them are written, what has these names stays as it
/// is.
class FilesTogether {
 public:
  explicit FilesTogether(const std::filesystem::path& folder);
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;
  ~FilesTogether();
  /// Where to write the file that shall have this name. \throws RunError.
  std::filesystem::path place_of(const std::string& name);
  /// In the order in which they were asked for. \throws RunError.
  void give_names();

 private:
  std::filesystem::path folder_, place_;
  std::vector<std::string> names_;
};

/// contacts.csv: `a,b,pair,area,distance,nx,ny,nz,points`, in the network's order. \throws RunError.
void write_contacts_csv(const std::filesystem::path& file, const ContactNetwork& network);

}  // namespace macadam
