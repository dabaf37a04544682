#pragma once

// Loops over nodes and springs in the widest vectors that the machine has, found at run time.

#include <vector>

namespace cloth
{

/// The vectors that a loop is compiled for: those of the build, 4 doubles (AVX2 and FMA), 8 doubles (AVX-512).
enum class VectorWidth
{
  of_the_build,
  four_doubles,
  eight_doubles
};

/// What this machine can do, narrowest first.
const std::vector<VectorWidth>& vector_widths();

/// The width in use: the widest, unless told otherwise.
VectorWidth vector_width();

/// For tests and benchmarks, while nothing else runs. Throws std::invalid_argument for what the machine cannot do.
void use_vector_width(VectorWidth width);

/// As long as it lives, this thread takes numbers too small to be normal for 0, where the machine can: they take a
/// hundred times as long, and in single precision motions that have hardly begun are full of them.
class FlushedDenormals
{
public:
  FlushedDenormals();
  ~FlushedDenormals();
  FlushedDenormals(const FlushedDenormals&) = delete;
  FlushedDenormals& operator=(const FlushedDenormals&) = delete;

private:
  unsigned int before_;
};

/// Whether a loop may count on fused multiply-adds, as a type, so that it is known when the loop is compiled.
template <bool fused>
struct Arithmetic
{
  static constexpr bool has_fused_multiply_add = fused;
};

#if defined(__x86_64__) && defined(__GNUC__)

// A template of functions with a target each, into which all that is called is inlined before loops are vectorised. No
// code for a wider target is ever shared with the rest of the program, as whole files compiled for it would.
#if defined(__clang__)
#define CLOTH_EIGHT_DOUBLES "avx512f,avx512dq,avx512vl,avx2,fma"
#else
#define CLOTH_EIGHT_DOUBLES "avx512f,avx512dq,avx512vl,avx2,fma,prefer-vector-width=512"
#endif

template <typename Work>
[[gnu::target(CLOTH_EIGHT_DOUBLES), gnu::flatten]] void in_eight_doubles(Work& work)
{
  work(Arithmetic<true>{});
}

template <typename Work>
[[gnu::target("avx2,fma"), gnu::flatten]] void in_four_doubles(Work& work)
{
  work(Arithmetic<true>{});
}

#undef CLOTH_EIGHT_DOUBLES

#endif

/// Calls work(Arithmetic), compiled for each width, at the width in use. Loops in `work` should read what they need
/// from local variables, and functions that it calls must be visible, or they stay at the width of the build.
template <typename Work>
void in_widest_vectors(Work&& work)
{
#if defined(__x86_64__) && defined(__GNUC__)
  switch (vector_width())
  {
    case VectorWidth::eight_doubles:
      return in_eight_doubles(work);
    case VectorWidth::four_doubles:
      return in_four_doubles(work);
    case VectorWidth::of_the_build:
      break;
  }
#endif
  work(Arithmetic<false>{});
}

}  // namespace cloth
