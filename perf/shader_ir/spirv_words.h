// What is looked for and changed in SPIR-V words before SPIRV-Tools gets them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace halfframe::shader_ir {

/// Error(check) naming file, line and name for what ES 3.10 has and nothing here counts or runs: storage buffers,
/// images, atomic counters where a function uses one, and arrays that no device holds. `files`: as in gl::StageText.
void refuse_uncounted(const std::vector<std::uint32_t>& words, const std::vector<std::string>& files);

/// Cuts blocks of many calls into shorter ones that follow each other. The inliner of SPIRV-Tools moves a whole block
/// for each call in it: thousands of calls in one block would take minutes.
void cut_blocks_of_many_calls(std::vector<std::uint32_t>& words);

/// Writes a vector whose components were replaced one by one for a long while as a construction of its components,
/// which costs nothing. The simplifier of SPIRV-Tools walks from each replacement back over all before it.
void cut_chains_of_inserts(std::vector<std::uint32_t>& words);

}  // namespace halfframe::shader_ir
