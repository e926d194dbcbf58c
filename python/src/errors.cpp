// SPDX-License-Identifier: GPL-3.0-or-later
// errors.cpp  Defines the Python exceptions that correspond to the library's errors, and translates each error that is
// thrown into its exception, with the same text.
#include "macadam/error.hpp"

#include "python/src/bindings.hpp"

namespace macadam::python {
namespace {

namespace nb = nanobind;

PyObject* divergence = nullptr;

/// Adds a new exception type to the module and returns it. bases: the type, or the tuple of types, that it derives
/// from.
nb::object add_exception(nb::module_& m, const char* name, const char* doc, const nb::object& bases) {
  const std::string full = std::string("macadam.") + name;
  nb::object made = nb::steal(PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr));
  if (!made.is_valid()) nb::raise_python_error();
  m.attr(name) = made;
  return made;
}

PyObject *error_type, *input, *run, *interrupted;

}  // namespace

void bind_errors(nb::module_& m) {
  const nb::object exception = nb::borrow(PyExc_Exception);
  const nb::object base =
      add_exception(m, "Error", "Base class of all exceptions that Macadam raises on purpose.", exception);
  error_type = base.ptr();
  input = add_exception(
              m, "InputError",
              "The input is wrong. The message names file and line, or the particle, the value found and the value "
              "expected. Exit code 2 of the command.",
              nb::make_tuple(base, nb::borrow(PyExc_ValueError)))
              .ptr();
  const nb::object failed =
      add_exception(m, "RunError", "The input was good but the run failed. Exit code 1 of the command.",
                    nb::make_tuple(base, nb::borrow(PyExc_RuntimeError)));
  run = failed.ptr();
  interrupted = add_exception(m, "InterruptedError", "The run was asked to stop.", failed).ptr();
  divergence = add_exception(
                   m, "DivergenceError",
                   "A time step diverged: `particle` (its number in the specimen) moved too far at `time` [s].", failed)
                   .ptr();
  nb::register_exception_translator([](const std::exception_ptr& p, void*) {
    try {
      std::rethrow_exception(p);
    } catch (const DivergenceError& error) {
      const nb::object raised = nb::borrow(divergence)(error.what());
      raised.attr("particle") = error.particle;
      raised.attr("time") = error.time;
      PyErr_SetObject(divergence, raised.ptr());
    } catch (const InputError& error) { PyErr_SetString(input, error.what()); } catch (const InterruptedError& error) {
      PyErr_SetString(interrupted, error.what());
    } catch (const RunError& error) { PyErr_SetString(run, error.what()); } catch (const Error& error) {
      PyErr_SetString(error_type, error.what());
    }
  });
}

}  // namespace macadam::python
