// The scene's table of materials: how each pair of them meets (thesis §2.4.3.4, SPEC PH8).
#pragma once

#include <jet/physics.hpp>

#include <string>
#include <vector>

namespace jet {

/// A symmetric table of material pairs. The first material is the default of every body.
class JET_API MaterialTable {
public:
    explicit MaterialTable(std::string first = "default");

    std::size_t size() const { return names_.size(); }
    const std::vector<std::string>& names() const { return names_; }
    /// Index of the name, or -1.
    int find(std::string_view name) const;
    /// Adds a material that meets the others with the default pair; returns its index.
    std::size_t add(std::string name);
    void remove(std::size_t index);
    const MaterialPair& pair(std::size_t a, std::size_t b) const;
    /// Sets both (a, b) and (b, a).
    void setPair(std::size_t a, std::size_t b, const MaterialPair& pair);
    /// [size x size], row major.
    const std::vector<MaterialPair>& pairs() const { return pairs_; }
    bool operator==(const MaterialTable& other) const;

private:
    std::vector<std::string> names_;
    std::vector<MaterialPair> pairs_;
};

}  // namespace jet
