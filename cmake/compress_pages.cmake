# SPDX-License-Identifier: GPL-3.0-or-later
# CPack runs this on the files that it is about to pack. Compresses manual page and changelog as Debian's rules ask.
file(GLOB_RECURSE files ${CPACK_TEMPORARY_DIRECTORY}/CHANGELOG.md ${CPACK_TEMPORARY_DIRECTORY}/macadam.1)
foreach(file ${files})
  string(REPLACE CHANGELOG.md changelog name ${file})
  file(RENAME ${file} ${name})
  execute_process(COMMAND gzip -9n ${name} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
