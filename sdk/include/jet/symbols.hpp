// Symbols: groups of which a scene shows linked instances. What is changed in one instance changes in all, with the
// same commit, so that it is one undo step.
//
//   auto edit = scene.items().begin("Create symbol");
//   const Item* wheel = createSymbol(edit, scene, topSelection(scene), "Wheel");   // an instance stands in their place
//   placeSymbol(edit, *symbolOf(scene, *wheel), layer, Affine::translation({200, 0}));
//   edit.commit();
//
// An instance is a group whose members are real items: painting, hit tests, play, scripts and export see nothing else.
// Its link (which symbol, and where) is in the properties below, set like others, also with Transaction::set(). The
// symbols of a scene are groups, too, in a tree of their own, below the item kSymbolsId, which is neither painted nor
// played. The instance's own name, visibility, lock, effects and place are its own; what is in it is the symbol's.
// All on the thread that owns the scene; what cannot be done throws Failure, perhaps half-way: then leave the
// transaction.
#pragma once

#include <jet/scene.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jet {

/// The item whose children are the scene's symbols: scene.items().find(kSymbolsId). Every scene has it.
inline constexpr ItemId kSymbolsId{~std::uint64_t{1}};

// The properties of a link, on a group. Without "symbol" there is no link.
inline constexpr std::string_view kLinkSymbol = "symbol";         ///< item: the symbol
inline constexpr std::string_view kLinkX = "symbol-x";            ///< vector: where the unit vector along x goes
inline constexpr std::string_view kLinkY = "symbol-y";            ///< vector: where the unit vector along y goes
inline constexpr std::string_view kLinkOffset = "symbol-offset";  ///< vector: where the origin goes
/// On a symbol: text by which scenes know that their symbols are the same. Given when it is made, never changed.
inline constexpr std::string_view kSymbolKey = "symbol-key";
JET_API const PropertyTable& linkTable();

// --- asking

/// The scene's symbols, in the order made.
JET_API std::vector<const Item*> symbolsOf(const Scene& scene);
/// By name, the first one; null if none.
JET_API const Item* findSymbol(const Scene& scene, std::string_view name);
JET_API bool isSymbol(const Item& item);
/// The symbol an instance is linked to; 0 for any other item.
JET_API ItemId linkOf(const Item& item);
inline bool isInstance(const Item& item) { return static_cast<bool>(linkOf(item)); }
/// The symbol an instance is linked to; null for any other item.
JET_API const Item* symbolOf(const Scene& scene, const Item& item);
/// The nearest instance, or the symbol, that `item` is a part of; null for an item of its own.
JET_API const Item* holderOf(const Item& item);
/// Maps the symbol's coordinates to the scene: the identity where it stands as it was drawn.
JET_API Affine placementOf(const Item& instance);
/// All instances of the symbol in the scene, also those inside of other instances; by id. Those in symbols are not
/// among them.
JET_API std::vector<const Item*> instancesOf(const Scene& scene, const Item& symbol);
/// Is it used at all, by an instance in the scene or in another symbol?
JET_API bool isSymbolUsed(const Item& symbol);

// --- changing

/// Makes a symbol of the items (given as by topSelection(); layers are left out) and puts an instance in their place,
/// with these very items in it. An empty name, or one that is taken: the next free "Symbol 1". Null when nothing was
/// left to take, and then nothing was changed.
JET_API const Item* createSymbol(Transaction& edit, const Scene& scene, std::span<const Item* const> items,
                                 std::string name = {});
/// A new instance at the end of `parent`. Refused inside of the symbol itself.
JET_API const Item& placeSymbol(Transaction& edit, const Item& symbol, const Item& parent,
                                const Affine& placement = {});
/// Moves, turns or scales an instance; the same as Transaction::transform(), but from the symbol's coordinates.
JET_API void setPlacement(Transaction& edit, const Item& instance, const Affine& placement);
/// The instance shows another symbol from now on, in the same place.
JET_API void swapSymbol(Transaction& edit, const Item& instance, const Item& symbol);
/// A plain group from now on, with the same items in it.
JET_API void detachInstance(Transaction& edit, const Item& instance);
/// Refused while it is used: detach or delete its instances before.
JET_API void removeSymbol(Transaction& edit, const Item& symbol);

}  // namespace jet
