#include "provenance.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "cloth_sim/threads/processor.h"

#include "replaced_file.h"

namespace cloth
{

/// Written anew by cmake/commit.cmake whenever it changes.
extern const char* const source_commit;

namespace
{

std::string without_commas(std::string text)
{
  std::replace(text.begin(), text.end(), ',', ' ');
  return text;
}

}  // namespace

Provenance provenance_here()
{
  const std::string processors = std::to_string(std::thread::hardware_concurrency()) + " x ";
#ifdef __clang__
  const std::string compiler = std::string("clang ") + __clang_version__;
#else
  const std::string compiler = std::string("gcc ") + __VERSION__;
#endif
  return { without_commas(processors + processor_name()), without_commas(compiler + " " CLOTH_BENCH_BUILD_TYPE),
           without_commas(source_commit) };
}

void require_same_provenance(const std::string& folder, const Provenance& provenance)
{
  const std::string path = folder + "/made_by.txt";
  const std::array<std::pair<const char*, std::string>, 3> lines{
    { { "machine", provenance.machine }, { "compiler", provenance.compiler }, { "commit", provenance.commit } }
  };
  std::ifstream kept(path);
  if (!kept)
  {
    ReplacedFile file(path);
    for (const auto& [name, value] : lines)
    {
      file.stream() << name << ": " << value << "\n";
    }
    file.commit();
    return;
  }
  for (const auto& [name, value] : lines)
  {
    std::string line;
    std::getline(kept, line);
    if (line != std::string(name) + ": " + value)
    {
      throw std::runtime_error(folder + " has measurements of another " + name + " (there " + line + "; here " + value +
                               "): give another folder with --out, or take this one away");
    }
  }
}

}  // namespace cloth
