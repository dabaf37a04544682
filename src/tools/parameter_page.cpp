// Prints docs/parameters.md.

#include <iostream>

#include "cloth_sim/scene/parameter_table.h"

int main()
{
  std::cout << cloth::parameter_page();
  return 0;
}
