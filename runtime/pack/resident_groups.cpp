// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/resident_groups.h"

#include <numeric>

namespace hearth::pack
{

ResidentGroups::ResidentGroups(const formats::PackView& view)
    : begins_(view.pages().size() + 1, 0),
      groups_(view.groups().size()),
      first_of_set_(view.groups().size()),
      missing_of_set_(view.groups().size(), 0)
{
    for (uint32_t group = 0; group < groups_.size(); ++group)
    {
        first_of_set_[group] = group - view.groups()[group].set_offset;
        ++missing_of_set_[first_of_set_[group]];
        ++begins_[view.groups()[group].page];
    }
    // each offset begins at the end of its list, and moves to its start as groups are written from the back
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    for (auto group = static_cast<uint32_t>(groups_.size()); group-- > 0;)
        groups_[--begins_[view.groups()[group].page]] = group;
    changes_.reserve(groups_.size());
}

void ResidentGroups::add(uint32_t page)
{
    for (const uint32_t group : groupsInPage(page))
        if (--missing_of_set_[first_of_set_[group]] == 0)
            changeSet(first_of_set_[group], true);
}

void ResidentGroups::remove(uint32_t page)
{
    for (const uint32_t group : groupsInPage(page))
        if (missing_of_set_[first_of_set_[group]]++ == 0)
            changeSet(first_of_set_[group], false);
}

void ResidentGroups::changeSet(uint32_t first, bool resident)
{
    for (uint32_t group = first; group < first_of_set_.size() && first_of_set_[group] == first; ++group)
        changes_.push_back({group, resident});
}

} // namespace hearth::pack
