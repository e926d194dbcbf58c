// SPDX-License-Identifier: GPL-3.0-or-later
/// \file plugin_file.hpp  Libraries that this one looks for when it runs.
#pragma once

#include <string>

namespace macadam {

/// What is asked of a plugin.
struct PluginFile {
  const char* file;    ///< e.g. "libmacadam_cuda.so"
  const char* symbol;  ///< C name of the table that it exports
  int interface;       ///< the table begins with this number, of its build, and the version of Macadam as a C string
  const char* makes;   ///< what a build needs to make it, in words
};

/// The table of a plugin, which then stays loaded. It is looked for in the folders that MACADAM_PLUGIN_PATH names, with
/// colons between them, then beside this library. nullptr where there is none that fits; `why` then says it.
const void* find_plugin(const PluginFile& asked, std::string& why);

}  // namespace macadam
