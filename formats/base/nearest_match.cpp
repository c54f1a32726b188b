// Distance: R. Lowrance, R. Wagner, "An extension of the string-to-string correction problem", 1975
// (restricted form).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/nearest_match.h"

#include <algorithm>
#include <vector>

namespace hearth
{

size_t editDistance(std::string_view a, std::string_view b)
{
    std::vector<std::vector<size_t>> cost(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i)
        cost[i][0] = i;
    for (size_t j = 0; j <= b.size(); ++j)
        cost[0][j] = j;
    for (size_t i = 1; i <= a.size(); ++i)
        for (size_t j = 1; j <= b.size(); ++j)
        {
            const size_t change = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    return cost[a.size()][b.size()];
}

std::string nearestMatch(std::string_view word, std::span<const std::string> candidates)
{
    // long words are not typos of option names, and would take long
    constexpr size_t kMaxWordLength = 64;
    std::string best;
    if (word.size() > kMaxWordLength)
        return best;
    // one typo in three letters
    size_t best_distance = std::max<size_t>(word.size() / 3, 1) + 1;
    for (const std::string& candidate : candidates)
    {
        const size_t distance = editDistance(word, candidate);
        if (distance < best_distance)
        {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

} // namespace hearth
