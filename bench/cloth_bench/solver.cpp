#include "solver.h"

namespace cloth
{

const char* name_of(Setting setting)
{
  switch (setting)
  {
    case Setting::step:
      return "step";
    case Setting::tolerance:
      return "tolerance";
    case Setting::iterations:
      return "iterations";
    default:
      return "nodes_per_side";
  }
}

const char* name_of(Status status)
{
  switch (status)
  {
    case Status::ok:
      return "ok";
    case Status::unstable:
      return "unstable";
    case Status::not_converged:
      return "not_converged";
    default:
      return "too_slow";
  }
}

}  // namespace cloth
