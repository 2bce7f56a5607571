// Bytes to a shape, its axis and the certificate, for libFuzzer: `make fuzz-coverage`.
//
// The first byte says whether there are arcs and which method computes, the others are the rings.

#include "bytes.h"
#include "medial/medial.h"

using medial::Ring;
using medial::fuzz::fail;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t most = 200;  // points: certificates take seconds beyond
  medial::fuzz::Bytes bytes(data, size);
  const std::uint8_t what = bytes.byte();
  const std::vector<Ring> rings = medial::fuzz::rings_from(bytes, what & 1, most);
  medial::Options options{.threads = 1};
  if (what & 2) options.method = medial::method::Lee{};
  options.exterior = (what & 12) == 12;
  const auto shape = medial::build_shape(rings);
  if (!shape) {
    if (shape.error().code == medial::ErrorCode::internal) fail("build_shape(): internal", rings);
    return 0;
  }
  const auto axis = medial::compute(*shape, options);
  if (!axis) {
    const medial::ErrorCode code = axis.error().code;
    const bool fault = code == medial::ErrorCode::internal || code == medial::ErrorCode::malformed;
    if (fault) fail(to_string(axis.error()).c_str(), rings);
    return 0;
  }
  const medial::Certificate certificate = medial::verify(*shape, *axis, {.threads = 1});
  if (!certificate.passed) fail(certificate.failures.front().c_str(), rings);
  return 0;
}
