// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzz target without a fuzzing engine: every seed, then fixed mutants of the seeds. The same bytes
// come in every run, so that a failure repeats; searching for new ones is the work of preset `fuzz`.
// usage: NAME MUTANTS [FOLDER OF SEEDS]...
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;
using Dice = std::mt19937;

constexpr std::size_t kSizeMax = 4096;

std::size_t below(Dice& dice, std::size_t bound) { return bound == 0 ? 0 : dice() % bound; }

Bytes read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Every file of the folder, in the order of names; always begins with the empty input.
std::vector<Bytes> read_seeds(int argc, char** argv) {
  std::vector<std::filesystem::path> paths;
  for (int i = 2; i < argc; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      if (entry.is_regular_file()) paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> seeds(1);
  for (const auto& path : paths) seeds.push_back(read_file(path));
  return seeds;
}

void mutate_once(Bytes& bytes, const std::vector<Bytes>& seeds, Dice& dice) {
  const std::size_t at = below(dice, bytes.size() + 1);
  const auto here = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  switch (dice() % 5) {
    case 0:  // another byte
      if (at < bytes.size()) bytes[at] = static_cast<std::uint8_t>(dice());
      break;
    case 1:  // one bit
      if (at < bytes.size()) bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << (dice() % 8)));
      break;
    case 2:  // cut off
      bytes.resize(at);
      break;
    case 3:  // a byte too many
      bytes.insert(here, static_cast<std::uint8_t>(dice()));
      break;
    default: {  // the tail of another seed
      const Bytes& other = seeds[below(dice, seeds.size())];
      const auto tail = static_cast<std::ptrdiff_t>(below(dice, other.size() + 1));
      bytes.insert(here, other.begin() + tail, other.end());
    }
  }
}

Bytes mutant(const std::vector<Bytes>& seeds, Dice& dice) {
  Bytes bytes = seeds[below(dice, seeds.size())];
  for (std::size_t i = 1 + below(dice, 6); i > 0; --i) mutate_once(bytes, seeds, dice);
  if (bytes.size() > kSizeMax) bytes.resize(kSizeMax);
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  const int mutants = argc > 1 ? std::atoi(argv[1]) : 0;
  if (mutants <= 0) {
    std::fprintf(stderr, "expected a number of mutants above 0, and folders of seeds\n");
    return 2;
  }
  const std::vector<Bytes> seeds = read_seeds(argc, argv);
  for (const Bytes& seed : seeds) LLVMFuzzerTestOneInput(seed.data(), seed.size());
  Dice dice(1);
  for (int i = 0; i < mutants; ++i) {
    const Bytes bytes = mutant(seeds, dice);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%zu seeds and %d mutants went through\n", seeds.size() - 1, mutants);
  return 0;
}
