#include "reference_file.h"

#include <fstream>

#include "replaced_file.h"

namespace cloth
{
namespace
{

constexpr const char* title = "cloth_bench reference 1";

void write_numbers(std::ostream& stream, const double* numbers, Eigen::Index count)
{
  stream.write(reinterpret_cast<const char*>(numbers), static_cast<std::streamsize>(count * 8));
}

void read_numbers(std::istream& stream, double* numbers, Eigen::Index count)
{
  stream.read(reinterpret_cast<char*>(numbers), static_cast<std::streamsize>(count * 8));
}

}  // namespace

void write_reference(const std::string& path, const std::string& fingerprint, const Reference& reference)
{
  ReplacedFile file(path);
  std::ostream& stream = file.stream();
  const Eigen::Index nodes = reference.samples.empty() ? 0 : reference.samples.front().positions.rows();
  stream << title << "\n" << fingerprint << "\n" << reference.reason << "\n";
  stream << reference.accepted << " " << reference.samples.size() << " " << nodes << "\n";
  write_numbers(stream, &reference.horizon, 1);
  write_numbers(stream, &reference.disagreement, 1);
  write_numbers(stream, &reference.growth, 1);
  for (const ClothState& sample : reference.samples)
  {
    write_numbers(stream, &sample.time, 1);
    write_numbers(stream, sample.positions.data(), sample.positions.size());
    write_numbers(stream, sample.velocities.data(), sample.velocities.size());
  }
  file.commit();
}

std::optional<Reference> read_reference(const std::string& path, const std::string& fingerprint)
{
  std::ifstream stream(path, std::ios::binary);
  std::string first;
  std::string second;
  Reference reference;
  std::getline(stream, first);
  std::getline(stream, second);
  std::getline(stream, reference.reason);
  if (first != title || second != fingerprint)
  {
    return std::nullopt;
  }
  size_t samples = 0;
  Eigen::Index nodes = 0;
  stream >> reference.accepted >> samples >> nodes;
  stream.get();
  read_numbers(stream, &reference.horizon, 1);
  read_numbers(stream, &reference.disagreement, 1);
  read_numbers(stream, &reference.growth, 1);
  for (size_t s = 0; s < samples && stream; ++s)
  {
    ClothState sample{ Vectors(nodes, 3), Vectors(nodes, 3), 0.0 };
    read_numbers(stream, &sample.time, 1);
    read_numbers(stream, sample.positions.data(), sample.positions.size());
    read_numbers(stream, sample.velocities.data(), sample.velocities.size());
    reference.samples.push_back(std::move(sample));
  }
  return stream ? std::optional<Reference>(std::move(reference)) : std::nullopt;
}

}  // namespace cloth
