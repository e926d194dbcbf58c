// SPDX-License-Identifier: GPL-3.0-or-later
/// \file plugin_file.hpp  Finds and loads plugins. A plugin is a shared library that is not linked to the program but
/// searched for at run time.
#pragma once

#include <string>

namespace macadam {

/// Description of a plugin.
struct PluginFile {
  const char* file;    ///< e.g. "libmacadam_cuda.so"
  const char* symbol;  ///< C name of the table that it exports
  /// Version of the plugin's interface in this build. The table of the plugin must begin with the same number, followed
  /// by Macadam's version as a C string.
  int interface;
  const char* makes;  ///< requirements for building the plugin, in words, for the error message
};

/// Returns the table of a plugin, which then stays loaded. The plugin is searched for in the folders of
/// MACADAM_PLUGIN_PATH (separated by colons) and then in the folder of this library. Returns nullptr and stores the
/// reason in `why` if no file is found, or if the first file that is found has another version.
const void* find_plugin(const PluginFile& asked, std::string& why);

}  // namespace macadam
