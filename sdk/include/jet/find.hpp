// Finding items by name, type, properties, effects and layer.
//
//   query = { term }                      an item matches when all terms do
//   term  = [ "-" ] ( word | key ":" text | property op value )       "-": does not
//   op    = "=" | "!=" | "<" | "<=" | ">" | ">="
//   text  = word | '"' anything '"'       "*": any text, "?": any character; upper and lower case are the same
//
//   ball                          the name has "ball" in it
//   name:ball* type:shape         the whole name, the type
//   mass>2 fixed=true             a property of the item or of one of its effects; velocity.x<0
//   effect:polygon-face           has such an effect
//   layer:front symbol:wheel      lies in that layer; shows that symbol, or is a part of it
//   is:hidden is:locked is:instance -is:empty   states: also visible, unlocked, group
//   id:12 material:ice*           the item's number; any other key is a property, compared as text
#pragma once

#include <jet/scene.hpp>

#include <memory>
#include <string_view>
#include <vector>

namespace jet {

/// A query that has been read. Copies share it. [any thread]
class JET_API FindQuery {
public:
    /// The error says what is wrong, its column where.
    static Result<FindQuery> parse(std::string_view text);

    /// Without any term: matches nothing.
    FindQuery();
    bool isEmpty() const;
    /// Without a scene no item shows a symbol. [owner's thread of the item]
    bool matches(const Item& item, const Scene* scene) const;

private:
    struct Private;
    std::shared_ptr<const Private> d_;
};

/// The items of the scene that match, in tree order (bottom first), whether shown or hidden. [owner's thread]
JET_API std::vector<const Item*> findItems(const Scene& scene, const FindQuery& query);

/// Post it to have the window show an area of a scene, opening its tab: events().post(&editor, ShowArea{...}). It is
/// not shown larger than 1:1 for the sake of a small item.
struct ShowArea {
    static constexpr EventType type{"org.jet.show-area"};
    Scene* scene;
    Box area;  ///< scene units
};

}  // namespace jet
