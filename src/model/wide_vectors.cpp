#include "cloth_sim/model/wide_vectors.h"

#include <algorithm>
#include <stdexcept>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace cloth
{
namespace
{

std::vector<VectorWidth> find_widths()
{
  std::vector<VectorWidth> widths{ VectorWidth::of_the_build };
#if defined(__x86_64__) && defined(__GNUC__)
  __builtin_cpu_init();
  const bool has_four = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_eight = has_four && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                         __builtin_cpu_supports("avx512vl");
  if (has_four)
  {
    widths.push_back(VectorWidth::four_doubles);
  }
  if (has_eight)
  {
    widths.push_back(VectorWidth::eight_doubles);
  }
#endif
  return widths;
}

VectorWidth& width_in_use()
{
  static VectorWidth width = vector_widths().back();
  return width;
}

}  // namespace

const std::vector<VectorWidth>& vector_widths()
{
  static const std::vector<VectorWidth> widths = find_widths();
  return widths;
}

VectorWidth vector_width()
{
  return width_in_use();
}

void use_vector_width(VectorWidth width)
{
  if (std::find(vector_widths().begin(), vector_widths().end(), width) == vector_widths().end())
  {
    throw std::invalid_argument("this machine has no vectors of that width");
  }
  width_in_use() = width;
}

#if defined(__SSE__)

FlushedDenormals::FlushedDenormals() : before_(_mm_getcsr())
{
  constexpr unsigned int flush_results = 0x8000;
  constexpr unsigned int flush_operands = 0x0040;
  _mm_setcsr(before_ | flush_results | flush_operands);
}

FlushedDenormals::~FlushedDenormals()
{
  _mm_setcsr(before_);
}

#else

FlushedDenormals::FlushedDenormals() : before_(0)
{
}

FlushedDenormals::~FlushedDenormals() = default;

#endif

}  // namespace cloth
