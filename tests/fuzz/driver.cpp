// Runs the fuzz target without libFuzzer, so that any compiler can.
//
//   solver_fuzz [-runs=N] [FILE ...]   N seeded strings of bytes (20000), or the given inputs
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  long runs = 20'000;
  bool files = false;
  for (int i = 1; i < argc; ++i) {
    if (!std::strncmp(argv[i], "-runs=", 6)) {
      runs = std::atol(argv[i] + 6);
      continue;
    }
    files = true;
    std::ifstream file(argv[i], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  if (files) return 0;
  for (long run = 0; run < runs; ++run) {
    std::mt19937_64 random(run);
    std::vector<std::uint8_t> bytes(20 + random() % 180);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%ld seeded inputs run\n", runs);
  return 0;
}
