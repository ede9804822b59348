// Finding a row of a budget.
#include "engine/frame/budget.h"

#include <algorithm>

namespace halfframe {

const BudgetRow* Budget::find(const std::string& row) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const BudgetRow& each) { return each.name == row; });
    return found == rows.end() ? nullptr : &*found;
}

}  // namespace halfframe
