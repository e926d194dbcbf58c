// SPDX-License-Identifier: GPL-3.0-or-later
// faults.c  A library to be preloaded into a program (glibc). It makes one allocation, or one call on its result files, fail.
//
// Calls count from the start of main(), so that loading the libraries does not count. Environment:
//   FAULT_KIND    memory, open, write, short (only half of a write is done, without an error), sync, rename, close, remove,
//                 mkdir
//   FAULT_AT      number of the call that fails, from 1 on; 0: none fails, the calls are only counted
//   FAULT_BYTES   instead of FAULT_AT: allocations fail if the program would then hold more than this number of bytes
//   FAULT_SPARE   part of the name of a library: allocations that this library itself requests neither fail nor count
//   FAULT_ERRNO   error number with which a call on a file fails
//   FAULT_FOLDER  only files in this folder count; an absolute path, as the program uses it
//   FAULT_REPORT  file that receives `hit KIND` when a call fails, and at the end, if none failed, `count KIND N` and the
//                 bytes held at the start of main() and at most: `count start N`, `count most N`
//   FAULT_TRACE   file that receives the call stack of the first call that fails
//   FAULT_CLOCK   if set, the time of day goes back by an hour with each query
//   FAULT_STACKS  file that receives a 64-bit hash of the call stack for each allocation
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <malloc.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

enum { memory_, open_, write_, short_, sync_, rename_, close_, remove_, mkdir_, kinds, most_files = 4096 };
static const char* const names[kinds] = {"memory", "open", "write", "short", "sync", "rename", "close", "remove", "mkdir"};

static atomic_bool active;
static atomic_long counted[kinds];
static atomic_long held, held_at_start, most_held;
static long at, most_bytes;
static int kind = -1, error_number = EIO, hit;
static const char* spare;
static uintptr_t spare_begin, spare_end;  // address range of the code of the spared library
static const char *folder, *report, *stacks, *trace;
static unsigned char marked[most_files];

enum { most_stacks = 1 << 22 };
static uint64_t* stack_hashes;

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);
extern void __libc_free(void*);

// Writes to the report without stdio, which allocates memory.
static void say(const char* what, const char* name, long number) {
  char text[80];
  size_t n = 0;
  for (const char* s = what; *s; ++s) text[n++] = *s;
  for (const char* s = name; *s; ++s) text[n++] = *s;
  if (number >= 0) {
    char digits[24];
    int d = 0;
    do digits[d++] = (char)('0' + number % 10);
    while ((number /= 10) > 0);
    text[n++] = ' ';
    while (d > 0) text[n++] = digits[--d];
  }
  text[n++] = '\n';
  const long file = syscall(SYS_openat, AT_FDCWD, report, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  syscall(SYS_write, file, text, n);
  syscall(SYS_close, file);
}

static __thread int inside __attribute__((tls_model("initial-exec")));

static void say_stack(void) {
  void* frames[64];
  inside = 1;
  const int depth = backtrace(frames, 64);
  const int file = (int)syscall(SYS_openat, AT_FDCWD, trace, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  backtrace_symbols_fd(frames, depth, file);
  syscall(SYS_close, file);
  inside = 0;
}

static int fails_now(int which, int now) {
  if (which != kind || !now) return 0;
  if (!hit && report) say("hit ", names[which], -1);
  if (!hit && trace) say_stack();
  hit = 1;
  errno = which == memory_ ? ENOMEM : error_number;
  return 1;
}

static int fails(int which) {
  if (!active || inside) return 0;
  const long number = ++counted[which];
  return fails_now(which, number == at);
}

static int memory_fails(size_t bytes, const void* caller) {
  if (!active || inside || ((uintptr_t)caller >= spare_begin && (uintptr_t)caller < spare_end)) return 0;
  if (most_bytes > 0) return fails_now(memory_, held + (long)bytes > most_bytes);
  if (stack_hashes) {
    inside = 1;
    void* frames[48];
    const int depth = backtrace(frames, 48);
    uint64_t hash = 1469598103934665603u;
    for (int k = 0; k < depth; ++k) hash = (hash ^ (uint64_t)frames[k]) * 1099511628211u;
    inside = 0;
    if (counted[memory_] < most_stacks) stack_hashes[counted[memory_]] = hash;
  }
  return fails(memory_);
}

static void* hold(void* memory) {
  const long now = held += memory ? (long)malloc_usable_size(memory) : 0;
  if (now > most_held) most_held = now;
  return memory;
}

#define CALLER __builtin_return_address(0)
void* malloc(size_t bytes) { return memory_fails(bytes, CALLER) ? NULL : hold(__libc_malloc(bytes)); }
void* calloc(size_t n, size_t bytes) { return memory_fails(n * bytes, CALLER) ? NULL : hold(__libc_calloc(n, bytes)); }
void* realloc(void* old, size_t bytes) {
  const size_t before = old ? malloc_usable_size(old) : 0;
  if (memory_fails(bytes > before ? bytes - before : 0, CALLER)) return NULL;
  void* const out = __libc_realloc(old, bytes);
  if (out || bytes == 0) held -= (long)before;
  return hold(out);
}
void* memalign(size_t align, size_t bytes) { return memory_fails(bytes, CALLER) ? NULL : hold(__libc_memalign(align, bytes)); }
void* aligned_alloc(size_t align, size_t bytes) {
  return memory_fails(bytes, CALLER) ? NULL : hold(__libc_memalign(align, bytes));
}
int posix_memalign(void** to, size_t align, size_t bytes) {
  if (memory_fails(bytes, CALLER)) return ENOMEM;
  return (*to = hold(__libc_memalign(align, bytes))) ? 0 : ENOMEM;
}
char* strdup(const char* text) {  // otherwise libc would be the caller, also for a spared library
  const size_t bytes = strlen(text) + 1;
  char* const out = memory_fails(bytes, CALLER) ? NULL : hold(__libc_malloc(bytes));
  return out ? memcpy(out, text, bytes) : NULL;
}
void free(void* memory) {
  if (memory) held -= (long)malloc_usable_size(memory);
  __libc_free(memory);
}

static int ours(const char* path) {
  return active && !inside && folder && path && strncmp(path, folder, strlen(folder)) == 0;
}
static int is_marked(int file) { return file >= 0 && file < most_files && marked[file]; }
enum { a_file = 1, a_folder };
static int mark(int file, unsigned char what) {
  if (file >= 0 && file < most_files) marked[file] = what;
  return file;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

// Only opening for writing can fail. Folders are opened for reading, to be locked and synchronised.
static int opens(int at_folder, const char* path, int flags, mode_t mode) {
  if (!ours(path)) return (int)syscall(SYS_openat, at_folder, path, flags, mode);
  const int writes = (flags & (O_WRONLY | O_RDWR)) != 0;
  if (writes && fails(open_)) return -1;
  const int file = (int)syscall(SYS_openat, at_folder, path, flags, mode);
  return writes ? mark(file, a_file) : flags & O_DIRECTORY ? mark(file, a_folder) : file;
}
#define WITH_MODE                             \
  mode_t mode = 0;                            \
  if (flags & (O_CREAT | __O_TMPFILE)) {      \
    va_list rest;                             \
    va_start(rest, flags);                    \
    mode = va_arg(rest, mode_t);              \
    va_end(rest);                             \
  }
int open(const char* path, int flags, ...) { WITH_MODE return opens(AT_FDCWD, path, flags, mode); }
int open64(const char* path, int flags, ...) { WITH_MODE return opens(AT_FDCWD, path, flags, mode); }
int openat(int folder_file, const char* path, int flags, ...) { WITH_MODE return opens(folder_file, path, flags, mode); }
int openat64(int folder_file, const char* path, int flags, ...) { WITH_MODE return opens(folder_file, path, flags, mode); }

static FILE* stream_of(FILE* (*real)(const char*, const char*), const char* path, const char* mode) {
  const int writes = ours(path) && strpbrk(mode, "wa+");
  if (writes && fails(open_)) return NULL;
  FILE* file = real(path, mode);
  if (writes && file) mark(fileno(file), a_file);
  return file;
}
FILE* fopen(const char* path, const char* mode) { return stream_of(REAL(fopen), path, mode); }
FILE* fopen64(const char* path, const char* mode) { return stream_of(REAL(fopen64), path, mode); }

static int halved(int file, size_t bytes) { return is_marked(file) && bytes > 1 && fails(short_); }
ssize_t write(int file, const void* bytes, size_t n) {
  if (is_marked(file) && fails(write_)) return -1;
  return syscall(SYS_write, file, bytes, halved(file, n) ? n / 2 : n);
}
static ssize_t writes_at(int file, const void* bytes, size_t n, off_t where) {
  if (is_marked(file) && fails(write_)) return -1;
  return syscall(SYS_pwrite64, file, bytes, halved(file, n) ? n / 2 : n, where);
}
ssize_t pwrite(int file, const void* bytes, size_t n, off_t where) { return writes_at(file, bytes, n, where); }
ssize_t pwrite64(int file, const void* bytes, size_t n, off_t where) { return writes_at(file, bytes, n, where); }
ssize_t writev(int file, const struct iovec* pieces, int n) {
  if (is_marked(file) && fails(write_)) return -1;
  if (n > 0 && halved(file, pieces[0].iov_len)) return syscall(SYS_write, file, pieces[0].iov_base, pieces[0].iov_len / 2);
  return syscall(SYS_writev, file, pieces, n);
}
int posix_fallocate(int file, off_t where, off_t bytes) {
  if (is_marked(file) && fails(write_)) return error_number;
  return REAL(posix_fallocate)(file, where, bytes);
}
int posix_fallocate64(int file, off_t where, off_t bytes) { return posix_fallocate(file, where, bytes); }
static int truncates(int file, off_t bytes) {
  if (is_marked(file) && fails(write_)) return -1;
  return (int)syscall(SYS_ftruncate, file, bytes);
}
int ftruncate(int file, off_t bytes) { return truncates(file, bytes); }
int ftruncate64(int file, off_t bytes) { return truncates(file, bytes); }

int fsync(int file) { return is_marked(file) && fails(sync_) ? -1 : (int)syscall(SYS_fsync, file); }
int fdatasync(int file) { return is_marked(file) && fails(sync_) ? -1 : (int)syscall(SYS_fdatasync, file); }

// Returns whether the close of the file fails. A close that fails closes the file nevertheless, as in Linux.
static int unmark(int file) {
  if (!is_marked(file)) return 0;
  const int what = marked[file];
  marked[file] = 0;
  return what == a_file && fails(close_);
}
int close(int file) {
  const int failing = unmark(file), why = errno;
  const int result = (int)syscall(SYS_close, file);
  if (failing) errno = why;
  return failing ? -1 : result;
}
int fclose(FILE* file) {
  const int failing = unmark(fileno(file));
  const int result = REAL(fclose)(file);
  if (failing) errno = error_number;
  return failing ? EOF : result;
}

int rename(const char* from, const char* to) {
  if (ours(to) && fails(rename_)) return -1;
  return (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}
int remove(const char* path) { return ours(path) && fails(remove_) ? -1 : REAL(remove)(path); }
int unlink(const char* path) { return ours(path) && fails(remove_) ? -1 : (int)syscall(SYS_unlinkat, AT_FDCWD, path, 0); }
int mkdir(const char* path, mode_t mode) {
  if (ours(path) && fails(mkdir_)) return -1;
  return (int)syscall(SYS_mkdirat, AT_FDCWD, path, mode);
}

static atomic_long asked_for_time;
int clock_gettime(clockid_t which, struct timespec* out) {
  const int result = (int)syscall(SYS_clock_gettime, which, out);
  if (result == 0 && which == CLOCK_REALTIME && getenv("FAULT_CLOCK")) out->tv_sec -= 3600 * ++asked_for_time;
  return result;
}
time_t time(time_t* out) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return out ? *out = now.tv_sec : now.tv_sec;
}

static int (*program)(int, char**, char**);

static void finish(void) {
  active = 0;
  if (report && !hit) {
    for (int k = 0; k < kinds; ++k) say("count ", names[k], counted[k]);
    say("count ", "start", held_at_start);
    say("count ", "most", most_held);
  }
  if (!stack_hashes) return;
  const long n = counted[memory_] < most_stacks ? counted[memory_] : most_stacks;
  const long file = syscall(SYS_openat, AT_FDCWD, stacks, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  syscall(SYS_write, file, stack_hashes, (size_t)n * sizeof *stack_hashes);
  syscall(SYS_close, file);
}

static int find_spare(struct dl_phdr_info* info, size_t size, void* unused) {
  (void)size, (void)unused;
  if (!strstr(info->dlpi_name, spare)) return 0;
  for (int k = 0; k < info->dlpi_phnum; ++k) {
    if (info->dlpi_phdr[k].p_type != PT_LOAD || !(info->dlpi_phdr[k].p_flags & PF_X)) continue;
    spare_begin = info->dlpi_addr + info->dlpi_phdr[k].p_vaddr;
    spare_end = spare_begin + info->dlpi_phdr[k].p_memsz;
  }
  return 1;
}

static int counting_main(int argc, char** argv, char** environment) {
  if (spare) dl_iterate_phdr(find_spare, NULL);
  held_at_start = most_held = held;
  active = 1;
  const int code = program(argc, argv, environment);
  finish();
  return code;
}

int __libc_start_main(int (*main_function)(int, char**, char**), int argc, char** argv, void (*init)(void),
                      void (*fini)(void), void (*linker_fini)(void), void* stack_end) {
  program = main_function;
  const char* text = getenv("FAULT_KIND");
  for (int k = 0; text && k < kinds; ++k) {
    if (strcmp(text, names[k]) == 0) kind = k;
  }
  at = (text = getenv("FAULT_AT")) ? atol(text) : 0;
  most_bytes = (text = getenv("FAULT_BYTES")) ? atol(text) : 0;
  spare = getenv("FAULT_SPARE");
  if ((text = getenv("FAULT_ERRNO"))) error_number = atoi(text);
  folder = getenv("FAULT_FOLDER");
  report = getenv("FAULT_REPORT");
  trace = getenv("FAULT_TRACE");
  stacks = getenv("FAULT_STACKS");
  void* room[2];
  if (stacks || trace) backtrace(room, 2);  // the first call of backtrace() loads a library, which allocates memory
  if (stacks) {
    stack_hashes = mmap(NULL, sizeof(uint64_t) * most_stacks, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  }
  __typeof__(&__libc_start_main) real = (__typeof__(real))dlsym(RTLD_NEXT, "__libc_start_main");
  return real(counting_main, argc, argv, init, fini, linker_fini, stack_end);
}
