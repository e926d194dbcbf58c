// SPDX-License-Identifier: GPL-3.0-or-later
// driver_faults.c  A library to be preloaded into a program that uses CUDA (x86-64). It makes one call of NVIDIA's
// driver fail.
//
// It has the driver's library name, so that the CUDA runtime uses it as the driver. It looks up every function in the
// real driver, and returns a replacement that counts the calls and does not make the call that is to fail. Environment:
//   FAULT_DRIVER  path of the real driver
//   FAULT_KIND    kind of the call: memory, launch, together (launches whose blocks wait for one another), graph
//   (launches
//                 of several kernels with their arguments), wait, copy, other; lost: every call fails from a launch on;
//                 dies, dies-together: the launch is made, but with invalid values instead of all pointers and numbers,
//                 so that the kernel fails while it runs
//   FAULT_AT      number of the call of this kind that fails, from 1 on; 0: none fails, the calls are only counted
//   FAULT_REPORT  file that receives `hit FUNCTION` when a call fails, and at the end, if none failed, `count KIND N`
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { memory, launch, together, graph, wait_, copy, other, kinds };
static const char* const kind_names[kinds] = {"memory", "launch", "together", "graph", "wait", "copy", "other"};
enum {
  out_of_memory = 2,
  not_initialised = 3,
  not_found = 500,
  device_unavailable = 46,
  launch_out_of_resources = 701,
  launch_failed = 719
};

// All functions of the driver take integers and pointers and return a code. So one function type with many arguments
// serves all functions: each function ignores the arguments that it does not have.
typedef intptr_t W;
typedef int (*Function)(W, W, W, W, W, W, W, W, W, W, W, W, W, W);
#define TAKEN W a, W b, W c, W d, W e, W f, W g, W h, W i, W j, W k, W l, W m, W n
#define GIVEN a, b, c, d, e, f, g, h, i, j, k, l, m, n

enum { most_functions = 1024 };
static Function real[most_functions];
static char names[most_functions][64];
static int kind_of[most_functions];
static atomic_int functions;
static atomic_long counted[kinds], launched;
static atomic_int hit;
static int kind = -1, losing, dying;
static long at;
static const char* report;

static void say(const char* what, const char* name, long number) {
  FILE* const out = report ? fopen(report, "a") : NULL;
  if (!out) return;
  number < 0 ? fprintf(out, "%s %s\n", what, name) : fprintf(out, "%s %s %ld\n", what, name, number);
  fclose(out);
}

static int code_of(int which) {
  switch (which) {
    case memory:
      return out_of_memory;
    case launch:
    case together:
    case graph:
      return launch_out_of_resources;
    case other:
      return device_unavailable;
    default:
      return launch_failed;
  }
}

// Launches a kernel with arguments whose bytes are all 0x5a. Read as a pointer, these bytes are an invalid address on
// every 64-bit machine.
static int launched_with_nonsense(int function, TAKEN) {
  enum { most_parameters = 64 };
  static char nonsense[32768];  // CUDA's limit for all arguments of a kernel
  static void* parameters[most_parameters];
  memset(nonsense, 0x5a, sizeof nonsense);
  for (int x = 0; x < most_parameters; ++x) parameters[x] = nonsense;
  if (strstr(names[function], "LaunchKernelEx"))
    c = (W)parameters;
  else
    j = (W)parameters;
  return real[function](GIVEN);
}

static int pass(int function, TAKEN) {
  const int which = kind_of[function];
  const int launches = which == launch || which == together || which == graph;
  long number = ++counted[which];
  if (losing) {
    if (hit) return launch_failed;
    number = launches ? ++launched : 0;
  }
  if ((losing ? launches : which == kind) && number == at) {
    hit = 1;
    say("hit", names[function], -1);
    if (dying) return launched_with_nonsense(function, GIVEN);
    return losing ? launch_failed : code_of(which);
  }
  return real[function](GIVEN);
}

// Defines 1024 functions, each with its own number.
#define NUMBERS16(x)                                                                                            \
  EACH(x##0)                                                                                                    \
  EACH(x##1) EACH(x##2) EACH(x##3) EACH(x##4) EACH(x##5) EACH(x##6) EACH(x##7) EACH(x##8) EACH(x##9) EACH(x##a) \
      EACH(x##b) EACH(x##c) EACH(x##d) EACH(x##e) EACH(x##f)
#define NUMBERS256(x)                                                                                                 \
  NUMBERS16(x##0)                                                                                                     \
  NUMBERS16(x##1) NUMBERS16(x##2) NUMBERS16(x##3) NUMBERS16(x##4) NUMBERS16(x##5) NUMBERS16(x##6) NUMBERS16(x##7)     \
      NUMBERS16(x##8) NUMBERS16(x##9) NUMBERS16(x##a) NUMBERS16(x##b) NUMBERS16(x##c) NUMBERS16(x##d) NUMBERS16(x##e) \
          NUMBERS16(x##f)
#define ALL_NUMBERS NUMBERS256(0x0) NUMBERS256(0x1) NUMBERS256(0x2) NUMBERS256(0x3)
#define EACH(x) \
  static int pass_##x(TAKEN) { return pass(x, GIVEN); }
ALL_NUMBERS
#undef EACH
#define EACH(x) pass_##x,
static const Function between[most_functions] = {ALL_NUMBERS};

static int kind_by_name(const char* name) {
  if (strstr(name, "Free") || strstr(name, "Destroy")) return other;
  if (strstr(name, "MemAlloc") || strstr(name, "MemHostAlloc") || strstr(name, "MemCreate") ||
      strstr(name, "MemAddressReserve"))
    return memory;
  if (strstr(name, "LaunchCooperative")) return together;
  if (strstr(name, "GraphLaunch")) return graph;
  if (strstr(name, "Launch")) return launch;
  if (strstr(name, "Synchronize") || strstr(name, "EventQuery") || strstr(name, "StreamQuery")) return wait_;
  if (strstr(name, "Memcpy") || strstr(name, "Memset")) return copy;
  return other;
}

// Replaces a function, except functions that describe an error or look up other functions.
static void put_between(const char* name, void** function) {
  if (!*function || strstr(name, "GetError") || strstr(name, "GetProcAddress") || strstr(name, "GetExportTable"))
    return;
  for (int x = 0; x < functions && x < most_functions; ++x) {
    if (real[x] == (Function)*function) {
      *function = (void*)between[x];
      return;
    }
  }
  const int x = functions++;
  if (x >= most_functions) return;
  real[x] = (Function)*function;
  snprintf(names[x], sizeof names[x], "%s", name);
  kind_of[x] = kind_by_name(name);
  *function = (void*)between[x];
}

static void* of_driver(const char* name) {
  static void* driver;
  if (!driver) {
    const char* const file = getenv("FAULT_DRIVER");
    driver = file ? dlopen(file, RTLD_NOW) : NULL;
    if (!driver) fprintf(stderr, "driver_faults: %s\n", file ? dlerror() : "FAULT_DRIVER is not given");
  }
  return driver ? dlsym(driver, name) : NULL;
}

int cuGetProcAddress_v2(const char* name, void** function, int version, uint64_t flags, int* found) {
  int (*const ask)(const char*, void**, int, uint64_t, int*) = of_driver("cuGetProcAddress_v2");
  if (!ask) return not_found;
  if (strcmp(name, "cuGetProcAddress") == 0) {  // later look-ups must also use this function
    *function = (void*)cuGetProcAddress_v2;
    if (found) *found = 0;
    return 0;
  }
  const int code = ask(name, function, version, flags, found);
  if (code == 0) put_between(name, function);
  return code;
}
int cuGetProcAddress(const char* name, void** function, int version, uint64_t flags) {
  return cuGetProcAddress_v2(name, function, version, flags, NULL);
}
int cuDriverGetVersion(int* version) {
  int (*const ask)(int*) = of_driver("cuDriverGetVersion");
  return ask ? ask(version) : not_initialised;
}
int cuInit(unsigned flags) {
  int (*const ask)(unsigned) = of_driver("cuInit");
  return ask ? ask(flags) : not_initialised;
}
int cuGetExportTable(const void** table, const void* id) {
  int (*const ask)(const void**, const void*) = of_driver("cuGetExportTable");
  return ask ? ask(table, id) : not_initialised;
}

__attribute__((constructor)) static void begin(void) {
  const char* text = getenv("FAULT_KIND");
  losing = text && strcmp(text, "lost") == 0;
  dying = text && strncmp(text, "dies", 4) == 0;
  if (dying) text = strcmp(text, "dies-together") == 0 ? "together" : "launch";
  for (int x = 0; text && x < kinds; ++x) {
    if (strcmp(text, kind_names[x]) == 0) kind = x;
  }
  at = (text = getenv("FAULT_AT")) ? atol(text) : 0;
  report = getenv("FAULT_REPORT");
}
__attribute__((destructor)) static void end(void) {
  for (int x = 0; x < kinds && !hit; ++x) say("count", kind_names[x], counted[x]);
}
