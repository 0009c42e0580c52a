// Style sheets of a drawing: which declarations hold for which element (CSS 2.1 selectors, specificity, !important).
#pragma once

#include "document.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace jet::svg {

/// "fill: red" of a rule or a style attribute. The views live as long as the sheet or the document.
struct Declaration {
    std::string_view property, value;
    bool important = false;
};
/// Reads "property: value; ..." without comments.
std::vector<Declaration> parseDeclarations(std::string_view text);
/// The same text without /* comments */.
std::string withoutComments(std::string_view text);

/// One compound selector: rect.solid#ground[fill="red"]:first-child.
struct Compound {
    enum class Relation { Self, Descendant, Child, Sibling };  ///< to the compound on its right
    struct Attribute {
        std::string name, value;
        char test = 0;  ///< 0: present; '=': equal; '~': a word; '^', '$', '*': begins, ends, contains; '|': language
    };
    Relation relation = Relation::Self;
    std::string type, id;
    std::vector<std::string> classes;
    std::vector<Attribute> attributes;
    bool firstChild = false;
};

class StyleSheet {
public:
    /// Gathers all <style> elements of the document.
    explicit StyleSheet(const Document& document);

    /// Calls with each declaration that holds for the element and its rank: a higher rank wins, among equals the later.
    void match(ElementIndex e, const std::function<void(const Declaration&, std::uint64_t rank)>& visit) const;
    bool isEmpty() const { return rules_.empty(); }

private:
    struct Rule {
        std::vector<Compound> selector;  ///< from right to left: the first is the element itself
        std::uint64_t rank = 0;
        std::shared_ptr<std::vector<Declaration>> declarations;
    };

    void read(std::string_view css);
    void addRule(std::string_view selectors, std::string_view block);
    bool matches(const Rule& rule, ElementIndex e) const;
    bool matchesFrom(const Rule& rule, std::size_t step, ElementIndex e, int& budget) const;

    const Document& document_;
    std::vector<std::unique_ptr<std::string>> texts_;
    std::vector<Rule> rules_;
    // Rules by the most telling part of their right-most compound, so that an element meets few of them.
    std::unordered_map<std::string, std::vector<std::size_t>> byId_, byClass_, byType_;
    std::vector<std::size_t> general_;
};

}  // namespace jet::svg
