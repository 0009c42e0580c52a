// Properties are declared once, in a table per item type or effect. The XML, the Inspector, tool options, undo, script
// access and documentation come from the table: a plugin author who adds a property writes one line and no interface.
#pragma once

#include <jet/value.hpp>

#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace jet {

/// One declared property.
struct PropertySpec {
    std::string id;     ///< stable, in files and scripts: lower-case words joined by '-'
    std::string label;  ///< for people; translated by the host
    ValueKind kind = ValueKind::None;
    Value fallback;  ///< the default
    std::string unit;
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    std::vector<std::string> choices;  ///< for kind Choice
    std::string help;                  ///< one sentence
    bool multiline = false;            ///< text edited as a block (scripts)

    PropertySpec&& in(std::string u) && { return unit = std::move(u), std::move(*this); }
    PropertySpec&& range(double lo, double hi) && { return minimum = lo, maximum = hi, std::move(*this); }
    PropertySpec&& says(std::string h) && { return help = std::move(h), std::move(*this); }

    /// Is the value of this kind, finite and in range (a vector: both components)? The error names all three.
    JET_API Result<void> check(const Value& value) const;
};

/// A table of declared properties, in the order people see them.
class JET_API PropertyTable {
public:
    PropertyTable() = default;
    PropertyTable(std::initializer_list<PropertySpec> specs) : specs_(specs) {}

    const PropertySpec* find(std::string_view id) const;
    std::span<const PropertySpec> specs() const { return specs_; }

private:
    std::vector<PropertySpec> specs_;
};

// How a table is written:
// PropertyTable{ real("mass", "Mass", 1).in("kg").range(0.001, 1e6), flag("fixed", "Fixed", false) }
JET_API PropertySpec flag(std::string id, std::string label, bool fallback);
JET_API PropertySpec integer(std::string id, std::string label, std::int64_t fallback);
JET_API PropertySpec real(std::string id, std::string label, double fallback);
JET_API PropertySpec vector(std::string id, std::string label, Vec2 fallback);
JET_API PropertySpec color(std::string id, std::string label, Color fallback);
JET_API PropertySpec text(std::string id, std::string label, std::string fallback, bool multiline = false);
JET_API PropertySpec choice(std::string id, std::string label, std::vector<std::string> choices);

/// Values by property id, kept sorted by id, so that equal content is equal in memory, in files and in hashes.
class JET_API Properties {
public:
    using Entry = std::pair<std::string, Value>;

    Properties() = default;
    Properties(std::initializer_list<Entry> entries);

    const Value* find(std::string_view id) const;
    /// The stored value, else the table's default; throws Failure for an id in neither.
    const Value& get(std::string_view id, const PropertyTable& table) const;
    void set(std::string_view id, Value value);
    bool erase(std::string_view id);
    std::span<const Entry> entries() const { return entries_; }
    bool isEmpty() const { return entries_.empty(); }
    bool operator==(const Properties&) const = default;

private:
    std::vector<Entry> entries_;
};

}  // namespace jet
