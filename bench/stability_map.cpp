// The stability map of docs/methods.md, measured: stability_map FILE.csv

#include <fstream>
#include <iostream>

#include "measured_stability.h"

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: stability_map FILE.csv\n";
    return 2;
  }
  std::ofstream output(argv[1]);
  cloth::write_stability_map(output);
  if (!output)
  {
    std::cerr << "stability_map: cannot write " << argv[1] << '\n';
    return 1;
  }
  return 0;
}
