// SPDX-License-Identifier: GPL-3.0-or-later
/// \file plugin_file.hpp  Finds and loads plugins: shared libraries that are not linked but searched for at run time.
#pragma once

#include <string>

namespace macadam {

/// Description of a plugin.
struct PluginFile {
  const char* file;    ///< e.g. "libmacadam_cuda.so"
  const char* symbol;  ///< C name of the table that it exports
  /// The table begins with this number, the interface of the build, followed by Macadam's version as a C string.
  int interface;
  const char* makes;  ///< requirements for building it, in words, for the message
};

/// Returns the table of a plugin, which then stays loaded. The plugin is searched for in the folders of
/// MACADAM_PLUGIN_PATH (separated by colons) and then in the folder of this library. Returns nullptr if no file is
/// found, or if the first one does not fit; `why` then gets the reason.
const void* find_plugin(const PluginFile& asked, std::string& why);

}  // namespace macadam
