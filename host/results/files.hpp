// SPDX-License-Identifier: GPL-3.0-or-later
/// \file files.hpp  Result files that survive a failed run.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "macadam/contact_network.hpp"
#include "macadam/results.hpp"

namespace macadam {

/// Makes the folder of the results. \throws RunError when it cannot be made.
void make_result_folder(const std::filesystem::path& folder);

/// Replaces a file by a rename, so that a reader finds the old text or the new. \throws RunError.
void write_whole(const std::filesystem::path& file, const std::string& text);

/// A name as a field of a CSV file: quoted where it has to be (RFC 4180).
std::string csv_field(const std::string& name);

/// response.csv: every line is flushed as it is measured.
class ResponseWriter {
 public:
  /// \throws RunError when the file cannot be opened.
  explicit ResponseWriter(const std::filesystem::path& file);
  /// \throws RunError when the disk refuses.
  void add(const ResponseSample& sample);

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

/// contacts.csv: `a,b,pair,area,distance,nx,ny,nz,points`, in the network's order. \throws RunError.
void write_contacts_csv(const std::filesystem::path& file, const ContactNetwork& network);

}  // namespace macadam
