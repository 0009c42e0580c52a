// What properties the items of the playing scene have. Taken when its scripts start, on the thread that owns the
// catalog; the tables stay as long as their plugins.
#pragma once

#include <jet/item.hpp>
#include <jet/property.hpp>

#include <map>
#include <optional>
#include <string>

namespace jet {
class Scene;
}

namespace jet::duktape {

class PropertyTables {
public:
    explicit PropertyTables(const Scene& scene);

    struct Found {
        const PropertySpec* spec = nullptr;  ///< null: nobody declares it
        std::optional<Value> stored;         ///< none: it has its default
    };
    /// Of the item, or, of a body, of the first of its effects that has it.
    Found find(const Item& item, std::string_view property) const;
    /// Ids of what the item type declares, else of what is stored, as a list.
    std::string known(const Item& item) const;

private:
    std::map<std::string, const PropertyTable*, std::less<>> types_, effects_;
};

}  // namespace jet::duktape
