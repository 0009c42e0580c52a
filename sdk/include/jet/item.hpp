// Item: one element of a scene. Plain data; only a Transaction changes it (see items_center.hpp).
#pragma once

#include <jet/property.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jet {

class Item;
class ItemsCenter;

// The item kinds of the SDK (SPEC IT1-IT9, images and text), as tags for Transaction::add<Kind>() and Item::is<Kind>().
struct GroupItem {
    static constexpr std::string_view type = "group";
};
struct LayerItem {
    static constexpr std::string_view type = "layer";
};
struct ShapeItem {
    static constexpr std::string_view type = "shape";
};
/// A shape with a physical body; which one is an effect's business (in-path-body, in-path-rigid-body).
struct BodyItem {
    static constexpr std::string_view type = "body";
};
/// A script, run at play in tree order (thesis §3.4.5). Its code is the property "code".
struct ScriptItem {
    static constexpr std::string_view type = "script";
};
/// A spring between the first and the last segment of its path (thesis §3.4.6).
struct SpringItem {
    static constexpr std::string_view type = "spring";
};
/// An angular spring; first, middle and last segment are a, centre and b.
struct RSpringItem {
    static constexpr std::string_view type = "rspring";
};
/// A sound file, played from scripts or when play starts (thesis §3).
struct SoundItem {
    static constexpr std::string_view type = "sound";
};
/// A picture from a file, spread over the frame its path's first segments span (see frameOf()).
struct ImageItem {
    static constexpr std::string_view type = "image";
};
/// Lines of text in a frame.
struct TextItem {
    static constexpr std::string_view type = "text";
};
/// A torque about the centre of its bounding box (thesis §3.4.7). Positive "value" turns left, as in the thesis's §4.3.
struct TorqueItem {
    static constexpr std::string_view type = "torque";
};

/// An effect on an item: which one, and with what values. Data only; behaviour is the Effect of that type.
struct EffectInstance {
    std::string type;
    Properties properties;
    bool visible = true;
    bool operator==(const EffectInstance&) const = default;
};

/// One element of the scene tree. References stay valid until the item is removed and its undo step forgotten;
/// keep the ItemId, not the reference, across events. Readable from the thread that owns the scene.
class JET_API Item {
public:
    Item(ItemId id, std::string_view type);
    ~Item();
    Item(const Item&) = delete;
    Item& operator=(const Item&) = delete;

    ItemId id() const { return id_; }
    const std::string& type() const { return type_; }
    template <class Kind>
    bool is() const
    {
        return type_ == Kind::type;
    }
    /// A group or a layer: an item that may have children.
    bool isContainer() const { return is<GroupItem>() || is<LayerItem>(); }

    const std::string& name() const { return name_; }
    bool visible() const { return visible_; }
    bool locked() const { return locked_; }
    /// Visible (locked) together with all its ancestors.
    bool shown() const;
    bool editable() const;

    const Path& path() const { return path_; }
    const Properties& properties() const { return properties_; }
    /// The stored property, or the common ones "name", "visible", "locked"; null where unset (the type's table has the
    /// default).
    std::optional<Value> property(std::string_view id) const;
    std::span<const EffectInstance> effects() const { return effects_; }
    /// The first effect of that type, or null.
    const EffectInstance* effect(std::string_view type) const;

    const Item* parent() const { return parent_; }
    std::span<const std::unique_ptr<Item>> children() const { return children_; }
    /// Position among the parent's children; 0 for a root.
    std::size_t index() const;
    /// The next (previous) child of the same parent, or null: the thesis's getSibling() and getPriorSibling().
    const Item* sibling() const;
    const Item* priorSibling() const;
    bool isAncestorOf(const Item& other) const;
    /// Depth-first pre-order, this item first. `visit` returns false to leave a subtree out.
    template <class Visit>
    void walk(Visit&& visit) const
    {
        if constexpr (std::is_void_v<decltype(visit(*this))>) {
            visit(*this);
        } else {
            if (!visit(*this)) return;
        }
        for (const auto& child : children_) child->walk(visit);
    }

    /// Exact bounds of the path and of all descendants. Cached.
    Box bounds() const;
    /// Grows with each change of this item's own data (not of its children): a key for caches derived from it.
    std::uint64_t revision() const { return revision_; }

    struct Mutator;  ///< the SDK's own way to change items; not defined for plugins

private:
    void touch();

    ItemId id_;
    std::string type_;
    std::string name_;
    Path path_;
    Properties properties_;
    std::vector<EffectInstance> effects_;
    Item* parent_ = nullptr;
    std::vector<std::unique_ptr<Item>> children_;
    bool visible_ = true;
    bool locked_ = false;
    mutable bool boundsValid_ = false;
    mutable std::uint32_t index_ = 0;  // where it was last found among its siblings: a hint
    mutable std::uint32_t order_ = 0;  // place in painting order, as the scene last counted it
    std::uint32_t slot_ = ~0U;         // in the scene's spatial index
    mutable Box bounds_;
    std::uint64_t revision_ = 0;
};

/// First item of that name in the subtree, depth first (the thesis's ItemUtils.getItemByName); null if none.
JET_API const Item* findByName(const Item& root, std::string_view name);
/// Nearest by that name (thesis §3.4.5): siblings, then their subtrees, then the same one level up, and so on.
JET_API const Item* findClosestByName(const Item& from, std::string_view name);
JET_API const Item& topGroup(const Item& item);
/// Is `a` painted before `b`, which is in the same tree? A parent comes before its children.
JET_API bool isPaintedBefore(const Item& a, const Item& b);
/// The frame of an image or text: maps the unit square (y down) to the parallelogram of the path's first, second and
/// last segment, so that it turns and scales with the path; to the bounding box when the path has fewer than four.
JET_API Affine frameOf(const Path& path);

}  // namespace jet
