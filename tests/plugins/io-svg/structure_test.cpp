// What belongs to what: layers, groups, names, references, conditions.
#include "svg_fixture.hpp"

#include <cmath>

namespace jet::test {

using SvgStructureTest = SvgTest;

TEST_F(SvgStructureTest, LayersGroupsAndNamesAreKept)
{
    draw("<g inkscape:groupmode='layer' inkscape:label='Terrain' id='layer1'><g id='hill'>"
         "<path id='slope' d='M0 0H9V9'/><path d='M0 0H9V9'/></g>"
         "<g inkscape:groupmode='layer' inkscape:label='Sub'/></g><g id='top'/>");
    const Item* terrain = named("Terrain");
    ASSERT_TRUE(terrain);
    EXPECT_TRUE(terrain->is<LayerItem>());
    ASSERT_TRUE(named("hill"));
    EXPECT_TRUE(named("hill")->is<GroupItem>());
    EXPECT_EQ(named("hill")->parent(), terrain);
    EXPECT_EQ(named("slope")->parent(), named("hill"));
    EXPECT_TRUE(named("Sub")->is<LayerItem>());
    EXPECT_TRUE(named("top")->is<LayerItem>());
}

TEST_F(SvgStructureTest, TheOrderOfPaintingIsKept)
{
    draw("<rect id='a' width='1' height='1'/><g id='b'><rect id='c' width='1' height='1'/></g><rect id='d' width='1' "
         "height='1'/>");
    const auto children = scene_.root().children();
    ASSERT_EQ(children.size(), 3u);
    EXPECT_EQ(children[0]->name(), "a");
    EXPECT_EQ(children[1]->name(), "b");
    EXPECT_EQ(children[2]->name(), "d");
}

TEST_F(SvgStructureTest, AnImportIsOneUndoStep)
{
    const std::uint64_t before = scene_.hash();
    draw("<g><rect width='5' height='5'/></g><circle r='4'/>");
    EXPECT_EQ(scene_.undoRedo().position(), 1u);
    scene_.undoRedo().undo();
    EXPECT_EQ(scene_.hash(), before);
}

TEST_F(SvgStructureTest, DefinitionsAreDrawnOnlyWhereUsed)
{
    draw("<defs><rect id='r' width='5' height='5'/></defs><symbol id='s'><circle r='3'/></symbol>"
         "<clipPath id='c'><rect width='5' height='5'/></clipPath><marker><path d='M0 0H9V9'/></marker>"
         "<use id='twice' xlink:href='#r'/><use xlink:href='#r' x='9'/><use href='#s'/>");
    ASSERT_EQ(shapes().size(), 3u);
    EXPECT_EQ(shapes()[0]->name(), "twice");
    EXPECT_EQ(shapes()[1]->name(), "r");
}

TEST_F(SvgStructureTest, AUsedGroupIsAGroupOfItsOwn)
{
    draw("<defs><g id='wheel'><circle r='3'/><circle r='2'/></g></defs><use id='front' xlink:href='#wheel' x='10'/>"
         "<use xlink:href='#wheel' fill='red'/>");
    ASSERT_TRUE(named("front"));
    EXPECT_EQ(named("front")->children().size(), 2u);
    EXPECT_EQ(face(*shapes()[2]), "#ff0000");  // inherited through the use
}

TEST_F(SvgStructureTest, ReferencesInACircleEnd)
{
    draw("<g id='a'><use xlink:href='#b'/><rect width='1' height='1'/></g>\n<g id='b'><use xlink:href='#a'/></g>\n"
         "<use id='self' xlink:href='#self'/>");
    EXPECT_TRUE(noted("leads back to itself")) << allNotes();
    EXPECT_LT(shapes().size(), 10u);
}

TEST_F(SvgStructureTest, ASwitchDrawsItsFirstAcceptableChild)
{
    draw("<switch><rect id='de' systemLanguage='de' width='1' height='1'/><rect id='ai' requiredExtensions='x' "
         "width='1' height='1'/>"
         "<rect id='en' systemLanguage='de, en-US' width='1' height='1'/><rect id='last' width='1' "
         "height='1'/></switch>");
    EXPECT_EQ(shape().name(), "en");
}

TEST_F(SvgStructureTest, OnlySvgElementsAreDrawnWhateverTheirPrefix)
{
    const Result<void> result =
        importText("<s:svg xmlns:s='http://www.w3.org/2000/svg' xmlns='http://example.org/other'>"
                   "<s:rect id='a' width='5' height='5'/><rect id='b' width='5' height='5'/>"
                   "<box><s:rect id='c' width='5' height='5'/></box></s:svg>");
    ASSERT_TRUE(result);
    EXPECT_EQ(shape().name(), "a");
}

TEST_F(SvgStructureTest, ADrawingWithoutANamespaceIsDrawn)
{
    ASSERT_TRUE(importText("<svg><rect width='5' height='5'/></svg>"));
    EXPECT_EQ(shapes().size(), 1u);
}

TEST_F(SvgStructureTest, EntitiesOfTheDrawingAreExpanded)
{
    // Illustrator writes its namespaces and styles so.
    ASSERT_TRUE(importText("<!DOCTYPE svg [ <!ENTITY ns 'http://www.w3.org/2000/svg'> <!ENTITY red 'fill:#f00'>"
                           " <!ENTITY both '&red;;stroke:#00f'> <!ENTITY dot \"<rect width='5' height='5'/>\"> ]>\n"
                           "<svg xmlns='&ns;'><circle r='3' style='&both;'/>&dot;\n<text>x</text></svg>"));
    ASSERT_EQ(shapes().size(), 2u);
    EXPECT_EQ(face(*shapes()[0]), "#ff0000");
    EXPECT_EQ(strokeColor(*shapes()[0]), "#0000ff");
    EXPECT_EQ(items(TextItem::type).size(), 1u);
}

TEST_F(SvgStructureTest, MarkersStandAtTheVerticesAndTurnWithThePath)
{
    // An arrow of 2 x 1, whose tip is at the vertex, in stroke widths of 3.
    draw("<marker id='m' refX='2' refY='0.5' markerWidth='9' markerHeight='9' orient='auto'>"
         "<path id='arrow' d='M 0 0 L 2 0.5 L 0 1 Z'/></marker>"
         "<path id='line' d='M 10 10 L 10 50 L 90 50' fill='none' stroke='red' stroke-width='3' marker-start='url(#m)'"
         " marker-end='url(#m)'/>");
    const auto found = shapes();
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0]->name(), "line");
    expectBox(found[1]->bounds(), Box({8.5, 4}, {11.5, 10}));    // points down
    expectBox(found[2]->bounds(), Box({84, 48.5}, {90, 51.5}));  // points right
    EXPECT_EQ(face(*found[1]), "#000000");                       // not the line's style
}

TEST_F(SvgStructureTest, AMarkerInTheMiddleHalvesTheCorner)
{
    draw("<marker id='m' markerUnits='userSpaceOnUse' orient='auto'><path id='dash' d='M 0 0 H 10'/></marker>"
         "<polyline points='0,0 20,0 20,20' fill='none' marker-mid='url(#m)'/>");
    ASSERT_TRUE(named("dash"));
    const double side = 10 / std::sqrt(2.0);
    expectBox(named("dash")->bounds(), Box({20, 0}, {20 + side, side}));
}

TEST_F(SvgStructureTest, MarkersOfMarkersAreNotFollowed)
{
    draw("<marker id='m' overflow='visible'><path d='M 0 0 H 1' marker-start='url(#m)'/></marker>"
         "<path d='M 0 0 H 50' stroke='red' marker-start='url(#m)'/>");
    EXPECT_EQ(shapes().size(), 2u);
    EXPECT_TRUE(noted("in a marker")) << allNotes();
}

TEST_F(SvgStructureTest, WhatCannotBeDrawnIsNotedOnceAKindWithItsLine)
{
    draw("<text rotate='9'>a</text>\n<text rotate='9'>b</text>\n<image xlink:href='x.svg' width='9' height='9'/>\n"
         "<rect clip-path='url(#c)' mask='url(#m)' filter='url(#f)' width='5' height='5'/>\n"
         "<path d='M0 0H9' marker-end='url(#a)'/>\n<rect width='5' height='5' fill='url(#p)'/>\n<pattern id='p'/>");
    EXPECT_TRUE(noted("drawn upright (2 times", 2)) << allNotes();
    EXPECT_TRUE(noted("images that are drawings", 4));
    EXPECT_TRUE(noted("clip paths", 5));
    EXPECT_TRUE(noted("masks", 5));
    EXPECT_TRUE(noted("filters", 5));
    EXPECT_TRUE(noted("patterns", 7));
    EXPECT_EQ(notes_.size(), 6u) << allNotes();
}

}  // namespace jet::test
