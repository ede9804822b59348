// What a long search found so far, on disk: one that is stopped goes on where it was.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "perf/stability/search.h"

namespace halfframe::stability {

class KeptResults {
public:
    /// Under `folder`; empty: nothing is kept. `ground` is what results depend on beside the function and the effort:
    /// the driver.
    KeptResults(std::filesystem::path folder, std::string ground);

    /// What an earlier search of the same text with the same effort found; nothing where there was none.
    [[nodiscard]] std::optional<FunctionStability> find(const Subject& subject, const Effort& effort) const;
    /// Keeps a result. A folder that cannot be written keeps nothing.
    void keep(const FunctionStability& found, const Subject& subject, const Effort& effort);
    /// Removes everything that was found or kept here: the search has come to its end.
    void forget();

private:
    [[nodiscard]] std::filesystem::path file_of(const Subject& subject, const Effort& effort) const;

    std::filesystem::path folder_;
    std::string ground_;
    mutable std::vector<std::filesystem::path> files_;
};

}  // namespace halfframe::stability
