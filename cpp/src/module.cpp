// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

PYBIND11_MODULE(_core, module, pybind11::mod_gil_not_used()) {
  module.doc() = "The compiled part of pyrod. Use it through the package.";
  pyrod::bind::rotation(module);
  pyrod::bind::section(module);
  pyrod::bind::curve(module);
  pyrod::bind::arc(module);
  pyrod::bind::rod(module);
  pyrod::bind::job(module);
  pyrod::bind::statics(module);
  pyrod::bind::network(module);
  pyrod::bind::ladder(module);
}
