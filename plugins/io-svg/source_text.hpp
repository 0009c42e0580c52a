// SourceText: the bytes of a drawing as clean UTF-8, and the way back from an offset to line and column.
#pragma once

#include <jet/result.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jet::svg {

/// Takes UTF-8, UTF-16 (with a byte order mark) and Latin-1 (where declared). Bytes that no text holds become '?'.
class SourceText {
public:
    SourceText(std::span<const std::byte> data, std::string file);

    const std::string& text() const { return text_; }
    /// Offset of the first byte that was not text; none if all was.
    std::optional<std::size_t> firstBadByte() const { return firstBadByte_; }
    /// Entities whose expansion was refused, by the document's own declarations.
    const std::vector<std::string>& refusedEntities() const { return refusedEntities_; }
    /// Line and column, from 1, of an offset into text(). Columns count characters.
    Location locate(std::size_t offset) const;

private:
    void findLines();

    std::string file_;
    std::string original_;  // before entities were expanded: what the person sees
    std::string text_;
    std::vector<std::pair<std::size_t, std::size_t>>
        expansions_;                  // offset in text_ -> offset in original_, from there on
    std::vector<std::size_t> lines_;  // offsets of line starts in original_
    std::optional<std::size_t> firstBadByte_;
    std::vector<std::string> refusedEntities_;
};

}  // namespace jet::svg
