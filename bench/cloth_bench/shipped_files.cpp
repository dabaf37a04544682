#include "shipped_files.h"

#include <algorithm>
#include <filesystem>

#include "cloth_sim/scene/scene_reader.h"

namespace cloth
{
namespace
{

constexpr int most_nodes_of_small = 600;

bool is_small(const std::string& file)
{
  const SceneParams scene = read_scene(load_scene_file(file));
  return scene.sheet.rows * scene.sheet.cols <= most_nodes_of_small;
}

}  // namespace

std::string shipped_file(const std::string& name)
{
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const std::filesystem::path& folder :
       { program / "../../share/cloth_sim/bench", program / "../share/cloth_sim/bench",
         std::filesystem::path(CLOTH_BENCH_SOURCE_FOLDER) })
  {
    if (std::filesystem::exists(folder / name, ignored))
    {
      return (folder / name).lexically_normal().string();
    }
  }
  return {};
}

std::vector<std::string> scenes_of_the_program(bool small)
{
  std::vector<std::string> files;
  const std::string folder = shipped_file("scenes");
  if (folder.empty())
  {
    return files;
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    const std::string file = entry.path().string();
    if (entry.path().extension() == ".yaml" && (!small || is_small(file)))
    {
      files.push_back(file);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace cloth
