#include "bench_scene.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cloth_sim/scene/scene_reader.h"

namespace cloth
{
namespace
{

std::string name_of(const std::string& file)
{
  std::string name = std::filesystem::path(file).stem().string();
  for (char& letter : name)
  {
    letter = letter == ',' || letter == '"' || letter == '/' ? '_' : letter;
  }
  return name;
}

std::string content_of(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

}  // namespace

std::vector<BenchScene> read_scenes(const std::vector<std::string>& files)
{
  std::vector<BenchScene> scenes;
  for (const std::string& file : files)
  {
    try
    {
      scenes.push_back({ name_of(file), content_of(file), read_scene(load_scene_file(file)) });
    }
    catch (const SceneError& error)
    {
      const std::string message = error.what();
      throw SceneError(message.find(file) == std::string::npos ? file + ": " + message : message);
    }
    const auto has_name = [&](const BenchScene& other) { return other.name == scenes.back().name; };
    if (std::find_if(scenes.begin(), scenes.end(), has_name) != scenes.end() - 1)
    {
      throw SceneError("two scenes are called " + scenes.back().name + "; allowed: files of different names");
    }
  }
  return scenes;
}

std::string fingerprint_of(const std::string& text)
{
  // Fowler, Noll and Vo's hash 1a of 64 bits.
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char letter : text)
  {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  }
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

}  // namespace cloth
