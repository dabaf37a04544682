#include "matrix_folder.h"

#include <algorithm>
#include <filesystem>

#include "bench_scene.h"
#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{

std::string MatrixScene::fingerprint() const
{
  return fingerprint_of(yaml + format_number(horizon));
}

Problem MatrixScene::problem() const
{
  SceneParams full = params;
  full.plan = "full";
  return problem_of(name, Kind::trajectory, full, horizon);
}

MatrixScene matrix_scene(const std::string& name, const std::string& yaml, double horizon)
{
  return { name, yaml, read_scene(YAML::Load(yaml)), horizon };
}

MatrixFolder::MatrixFolder(const std::string& matrix, Half half, const Provenance& provenance)
  : path_(matrix + "/" + name_of(half))
{
  for (const char* part : { "/scenes", "/searched", "/motions" })
  {
    std::filesystem::create_directories(path_ + part);
  }
  require_same_provenance(path_, { provenance.machine, provenance.compiler, "see plans.csv" });
}

std::vector<std::string> MatrixFolder::all_searched() const
{
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_ + "/searched"))
  {
    if (entry.path().extension() == ".csv")
    {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace cloth
