#pragma once

#include <optional>
#include <string>

#include "reference.h"

namespace cloth
{

/// Keeps a reference, whole or not at all. Throws std::runtime_error where it cannot be written.
void write_reference(const std::string& path, const std::string& fingerprint, const Reference& reference);

/// The reference in a file, if it is there and has this fingerprint.
std::optional<Reference> read_reference(const std::string& path, const std::string& fingerprint);

}  // namespace cloth
