// SPDX-License-Identifier: GPL-3.0-or-later
/// \file limited_memory.hpp  `ulimit -v` and OpenBLAS.
#pragma once

namespace macadam {

/// Where the address space is limited, OpenBLAS must have one thread: those that it starts when it is loaded try for
/// ever where they cannot map their buffers, and the end of the program waits for them. It is told by the environment,
/// before it is loaded: the program is started again. Does nothing where there is no limit, or the environment says how
/// many.
void restart_with_one_blas_thread_where_memory_is_limited(char** argv);

}  // namespace macadam
