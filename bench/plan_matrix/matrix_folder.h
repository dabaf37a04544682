#pragma once

#include <string>
#include <vector>

#include "drawn_scene.h"
#include "problem.h"
#include "provenance.h"

namespace cloth
{

/// A scene of the matrix as it is kept: it is its file that counts, not the program that drew it.
struct MatrixScene
{
  std::string name;
  std::string yaml;
  SceneParams params;
  double horizon = 1.0;  ///< s

  /// Tells scenes and horizons apart.
  std::string fingerprint() const;
  /// The motion of the full model.
  Problem problem() const;
};

MatrixScene matrix_scene(const std::string& name, const std::string& yaml, double horizon);

/// Where one half of a matrix is kept.
class MatrixFolder
{
public:
  /// Makes it. Throws std::runtime_error where that cannot be, or where it has measurements of another machine or
  /// compiler; commits may differ.
  MatrixFolder(const std::string& matrix, Half half, const Provenance& provenance);

  std::string scenes() const
  {
    return path_ + "/scenes.csv";
  }
  /// The journal of all searches.
  std::string searches() const
  {
    return path_ + "/searches.csv";
  }
  std::string plans() const
  {
    return path_ + "/plans.csv";
  }
  std::string parts() const
  {
    return path_ + "/parts.csv";
  }
  std::string scene(const std::string& name) const
  {
    return path_ + "/scenes/" + name + ".yaml";
  }
  /// The rows of a search that came to its end.
  std::string searched(const std::string& name) const
  {
    return path_ + "/searched/" + name + ".csv";
  }
  /// The exact motion of a scene, or of that without some parts.
  std::string motion(const std::string& name) const
  {
    return path_ + "/motions/" + name + ".bin";
  }

  /// The names of the scenes whose search came to its end, in order.
  std::vector<std::string> all_searched() const;

private:
  std::string path_;
};

}  // namespace cloth
