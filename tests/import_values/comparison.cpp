// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/comparison.h"

#include <cmath>
#include <cstdio>

namespace hearth::test
{

namespace
{

constexpr size_t kMaxReported = 12; // lines for each file

std::string tableRow(const char* verb, const char* name, size_t count)
{
    char line[160];
    std::snprintf(line, sizeof(line), "%s  %-30s %12zu\n", verb, name, count);
    return line;
}

} // namespace

const char* valueName(Value value)
{
    constexpr std::array<const char*, static_cast<size_t>(Value::count)> kNames{
        "structure", "position", "normal",       "flat normal", "tangent",          "uv",
        "color",     "joint",    "weight",       "morph delta", "key time",         "key value",
        "node",      "instance", "inverse bind", "factor",      "texture transform"};
    return kNames[static_cast<size_t>(value)];
}

void Comparison::check(Value kind, double source, double part, double slack, const char* what, size_t where)
{
    ++compared_[static_cast<size_t>(kind)];
    const bool is_same = slack == 0 ? static_cast<double>(static_cast<float>(source)) == part
                                    : std::abs(source - part) <= slack;
    if (is_same)
        return;
    char line[240];
    std::snprintf(line, sizeof(line), "%s %s %zu: source %.9g, part %.9g", valueName(kind), what, where,
                  source, part);
    addDifference(line);
}

void Comparison::checkEqual(long long source, long long part, const char* what, size_t where)
{
    ++compared_[static_cast<size_t>(Value::structure)];
    if (source == part)
        return;
    char line[240];
    std::snprintf(line, sizeof(line), "%s %zu: source %lld, part %lld", what, where, source, part);
    addDifference(line);
}

void Comparison::exclude(Exclusion reason, size_t count)
{
    excluded_[static_cast<size_t>(reason)] += count;
}

void Comparison::fail(const std::string& what)
{
    addDifference(what);
}

void Comparison::addDifference(const std::string& line)
{
    if (++differences_ <= kMaxReported)
        report_ += file_ + ": " + line + "\n";
}

void Comparison::add(const Comparison& other)
{
    for (size_t i = 0; i < compared_.size(); ++i)
        compared_[i] += other.compared_[i];
    for (size_t i = 0; i < excluded_.size(); ++i)
        excluded_[i] += other.excluded_[i];
    differences_ += other.differences_;
    report_ += other.report_;
}

std::string Comparison::table() const
{
    std::string text;
    for (size_t i = 0; i < compared_.size(); ++i)
        text += tableRow("compared", valueName(static_cast<Value>(i)), compared_[i]);
    for (size_t i = 0; i < excluded_.size(); ++i)
        text += tableRow("excluded", kExclusions[i].name, excluded_[i]);
    return text;
}

} // namespace hearth::test
