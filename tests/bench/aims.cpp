// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/aims.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hearth::bench
{

namespace
{

bool isHeld(const Aim& aim, double value)
{
    return aim.bound == Bound::at_most ? value <= aim.limit : value >= aim.limit; // false for NaN
}

double findWorse(Bound bound, double a, double b)
{
    if (std::isnan(a) || std::isnan(b))
        return std::nan("");
    return bound == Bound::at_most ? std::max(a, b) : std::min(a, b);
}

} // namespace

const Aim& findAim(std::string_view bench, std::string_view figure, std::span<const Aim> aims)
{
    const auto found = std::find_if(
        aims.begin(), aims.end(), [&](const Aim& aim) { return aim.bench == bench && aim.figure == figure; });
    HEARTH_ASSERT(found != aims.end());
    return *found;
}

Judgement::Judgement(std::string_view bench, std::span<const Aim> aims) : bench_(bench), aims_(aims) {}

void Judgement::record(std::string_view figure, double value)
{
    const Aim& aim = findAim(bench_, figure, aims_);
    const auto [entry, is_first] = values_.emplace(aim.figure, value);
    if (!is_first)
        entry->second = findWorse(aim.bound, entry->second, value);
}

void Judgement::leaveOut(std::string_view figure)
{
    left_out_.insert(findAim(bench_, figure, aims_).figure);
}

std::string Judgement::describe() const
{
    std::string lines;
    for (const Aim& aim : aims_)
    {
        if (aim.bench != bench_)
            continue;
        const auto value = values_.find(aim.figure);
        char line[160];
        const int length =
            std::snprintf(line, sizeof(line), "aim: %.*s %s %g: ", static_cast<int>(aim.figure.size()),
                          aim.figure.data(), aim.bound == Bound::at_most ? "<=" : ">=", aim.limit);
        lines.append(line, static_cast<size_t>(length));
        if (value == values_.end())
            lines += left_out_.contains(aim.figure) ? "left out\n" : "NOT MEASURED\n";
        else
        {
            std::snprintf(line, sizeof(line), "%.4g, %s\n", value->second,
                          isHeld(aim, value->second) ? "met" : "MISSED");
            lines += line;
        }
    }
    return lines;
}

bool Judgement::isMet() const
{
    return std::all_of(aims_.begin(), aims_.end(),
                       [&](const Aim& aim)
                       {
                           if (aim.bench != bench_)
                               return true;
                           const auto value = values_.find(aim.figure);
                           return value == values_.end() ? left_out_.contains(aim.figure)
                                                         : isHeld(aim, value->second);
                       });
}

int Judgement::finish() const
{
    std::printf("%s", describe().c_str());
    std::fflush(stdout);
    if (isMet())
        return 0;
    std::fprintf(stderr, "bench %.*s: an aim is missed\n", static_cast<int>(bench_.size()), bench_.data());
    return 1;
}

} // namespace hearth::bench
