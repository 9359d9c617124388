// SPDX-License-Identifier: BSD-3-Clause
/// \file A member of a struct that lists its members: what must know all of them is made from it.
#pragma once

namespace pyrod {

template <class Owner, class T>
struct Field {
  const char* name;
  T Owner::* member;
  const char* doc = "";
};

template <class Owner, class T>
Field(const char*, T Owner::*) -> Field<Owner, T>;
template <class Owner, class T>
Field(const char*, T Owner::*, const char*) -> Field<Owner, T>;

}  // namespace pyrod
