// The ledger of hard cases: for each function and model the input that went worst, what was expected, and what came.
#pragma once

#include <string>
#include <vector>

#include "perf/stability/search.h"

namespace halfframe::stability {

struct LedgerRow {
    std::string function;  ///< as FunctionStability::title, behind the file: "surface/surface.glsl blinn_lobe"
    std::string model;
    std::string input;  ///< as input_text(), every digit of it
    double expected = 0.0, got = 0.0;
    double tolerance = 0.0;
    std::string reason;  ///< of the tolerance
};

/// The rows of a search, of the models alone: a context is not the same everywhere.
[[nodiscard]] std::vector<LedgerRow> ledger_rows(const std::vector<FunctionStability>& functions);

/// JSON, one row a line.
[[nodiscard]] std::string ledger_text(const std::vector<LedgerRow>& rows);
/// Error(input) for text that is no ledger; `path` names it.
[[nodiscard]] std::vector<LedgerRow> read_ledger(const std::string& text, const std::string& path);

/// A sentence for every row that is new, gone, or says something else. Figures of narrow models may differ by one of
/// their steps and float's by 16 fp32 steps: exp2, log2 and pow are the C library's.
[[nodiscard]] std::vector<std::string> differences(const std::vector<LedgerRow>& kept,
                                                   const std::vector<LedgerRow>& found);

}  // namespace halfframe::stability
