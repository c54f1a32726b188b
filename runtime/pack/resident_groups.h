// Set of resident groups, updated page by page: the rule of residentGroups (cut.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <span>
#include <vector>

namespace hearth::pack
{

/// Resident groups. A group is resident if it and the rest of its set are. Changes are reported group by
/// group, each at most once between two calls of clearChanges, if no page that was added since is removed (a
/// stream never does that in one frame).
class ResidentGroups
{
public:
    /// Construct with no resident group. Precondition: the view's meaning has been checked.
    explicit ResidentGroups(const formats::PackView& view);

    /// Mark a page as resident, or as not resident. Precondition: its state was the opposite.
    void add(uint32_t page);
    void remove(uint32_t page);

    struct Change
    {
        uint32_t group = 0;
        bool resident = false;
    };
    std::span<const Change> changes() const { return changes_; }
    void clearChanges() { changes_.clear(); }

    bool isResident(uint32_t group) const { return missing_of_set_[first_of_set_[group]] == 0; }

private:
    std::span<const uint32_t> groupsInPage(uint32_t page) const
    {
        return std::span(groups_).subspan(begins_[page], begins_[page + 1] - begins_[page]);
    }
    void changeSet(uint32_t first, bool resident);

    std::vector<uint32_t> begins_;       ///< for each page, start of its list in groups_; then the total
    std::vector<uint32_t> groups_;       ///< groups, sorted by page
    std::vector<uint32_t> first_of_set_; ///< first group of its set, for each group
    /// for the first group of each set: number of its groups that are not present
    std::vector<uint32_t> missing_of_set_;
    std::vector<Change> changes_;
};

} // namespace hearth::pack
