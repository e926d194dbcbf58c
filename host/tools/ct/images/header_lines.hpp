// SPDX-License-Identifier: GPL-3.0-or-later
/// \file header_lines.hpp  Reads the text header of an image file line by line. The header stands before the voxels or
/// in a separate file. Used for MetaImage and NRRD.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace macadam::ct {

/// Facts in the header of an image that ITK does not report.
struct HeaderFacts {
  std::filesystem::path voxels;       ///< the file that holds the voxels
  std::optional<double> unit = 1e-3;  ///< unit of lengths [m]; millimetres if the file names none, empty if the unit is
                                      ///< unknown
  bool white_is_zero = false;         ///< the grey values have to be inverted
  std::vector<std::string> notes;     ///< messages for the user

  /// Sets the unit that a header names. An unknown name makes the unit empty and adds a message.
  void take_unit(std::string_view name);
};

/// Lines of a header, one at a time, with error messages that name file and line.
class HeaderLines {
 public:
  /// `what` names the kind of header in error messages.
  HeaderLines(const std::filesystem::path& file, std::string what);

  /// Returns the next line without its line end, or nothing after the last line. \throws InputError for a line of
  /// 65,536 bytes or more, and for zero bytes or carriage returns inside a line, because ITK would end lines or values
  /// at such bytes, and this class would not.
  std::optional<std::string> next();
  /// \throws InputError that names the line read last.
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;
  [[noreturn]] void refuse(std::string_view key, std::string_view value, const std::string& expected) const;
  /// Returns the path of the file that a header line names, relative to the header's folder. \throws InputError if it
  /// does not exist or is not a file.
  std::filesystem::path beside(std::string_view key, std::string_view value) const;
  /// \throws InputError for a line that does not name exactly one existing file, for example a list of files.
  [[noreturn]] void refuse_voxels(std::string_view key, std::string_view value) const;

 private:
  std::filesystem::path file_;
  std::string what_, buffer_;
  std::ifstream in_;
  int number_ = 0;
};

/// Returns the text without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);

}  // namespace macadam::ct
