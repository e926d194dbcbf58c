// SPDX-License-Identifier: GPL-3.0-or-later
/// \file library_environment.hpp  Sets the environment variables that OpenMP and OpenBLAS read when they are loaded.
#pragma once

namespace macadam {

/// Sets the environment of the libraries and starts the program again, once, so that the libraries are loaded with this
/// environment. The process number stays the same. Variables that the user has set are not changed.
///
/// - OMP_WAIT_POLICY=passive, unless GOMP_SPINCOUNT is set: by default a thread of OpenMP that waits for work spins for
///   milliseconds. If other programs use the cores too, the spinning thread takes a core from the thread that it waits
///   for. With spinning threads, commands took 1.5 to 7 times as long. The threads of the time stepping do not wait in
///   OpenMP but at a barrier of Macadam (kernels/base/barrier.hpp). A command line with a single argument, such as
///   `macadam --version`, does not set this variable, except `macadam bench`.
/// - OPENBLAS_NUM_THREADS=1 if the address space is limited (`ulimit -v`): the threads that OpenBLAS starts when it is
/// loaded try forever to map their buffers, and the program waits for these threads when it ends.
void restart_with_library_environment(int argc, char** argv);

}  // namespace macadam
