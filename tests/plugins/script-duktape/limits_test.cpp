// Scripts that never end, want everything or try to get out: each is stopped, named, and the game goes on (SPEC SC5).
#include "script_fixture.hpp"

namespace jet::test {

namespace {

struct Evil {
    const char* name;
    const char* code;  ///< in line 2 of the listener or script
};

// Both as a script and as a listener.
const Evil kEvil[] = {
    {"EmptyLoop", "while (true) {}"},
    {"CaughtLoop", "for (;;) { try { for (;;); } catch (e) {} }"},
    {"FinallyLoop", "for (;;) { try { for (;;); } finally { continue; } }"},
    {"NestedFunctions", "function f() { try { f(); } catch (e) {} f(); } f();"},
    {"ForEach", "[1].forEach(function f() { for (;;) [1].forEach(function () {}); });"},
    {"SparseJoin", "new Array(2e9).join('')"},
    {"SparseIndexOf", "var a = []; a.length = 4e9; a.indexOf(1)"},
    {"SparseReverse", "var a = []; a[4e9] = 1; a.reverse()"},
    {"SparseSort", "var a = []; a[4e9] = 1; a.sort()"},
    {"SparseForEach", "Array.prototype.forEach.call({ length: 4e9 }, function () {})"},
    {"RegExpBacktracking", "/(a+)+$/.test(new Array(40).join('a') + '!')"},
    {"RegExpReplace", "var s = new Array(30).join('a') + '!'; for (;;) s.replace(/(a*)*b/g, '')"},
    {"RegExpBackReference", "/(a*)*\\1b/.test(new Array(20000).join('a'))"},
    {"StringSearch", "var a = new Array(24).join('a'), i; for (i = 0; i < 17; i++) a += a; for (;;) "
                     "a.indexOf(a.slice(0, a.length / 2) + 'b')"},
    {"StringSplit", "var s = new Array(22).join('ab'), i; for (i = 0; i < 17; i++) s += s; for (;;) s.split(s.slice(1, "
                    "s.length / 2) + 'c')"},
    {"StringConcat", "var s = new Array(1e6).join('x'); for (var i = 0; ; i++) s + i"},
    {"UpperCase", "var s = new Array(5e6).join('ą'); for (;;) s.toUpperCase().toLowerCase()"},
    {"Getter", "Object.defineProperty({}, 'x', { get: function () { for (;;); } }).x"},
    {"ValueOf", "+{ valueOf: function () { for (;;); } }"},
    {"ProxyTrap", "new Proxy({}, { get: function () { for (;;); } }).x"},
    {"JsonHook", "JSON.stringify({ toJSON: function () { for (;;); } })"},
    {"JsonReviver", "for (;;) JSON.parse('[[[[1]]]]', function (k, v) { return [v]; })"},
    {"SortComparator", "[3, 2, 1].sort(function () { for (;;); })"},
    {"ReplaceCallback", "'a'.replace(/a/, function () { for (;;); })"},
    {"HugeSource", "eval(new Array(2e6).join('a=1;'))"},
    {"HugeRegExp", "new RegExp(new Array(1e6).join('(a|b)'))"},
    {"Printing", "for (;;) print('x')"},
    {"Eval", "eval('for (;;);')"},
    {"NewFunction", "new Function('for (;;);')()"},
    {"BoundChain", "var f = function () {}; for (;;) f = f.bind(null, 1)"},
    {"ReduceRight", "[].reduceRight.call({ length: 4e9 }, function () {}, 0)"},
    {"Concat", "var a = [1]; for (;;) a = a.concat([1])"},
    {"Unshift", "var o = { length: 4e9 }; Array.prototype.unshift.call(o, 1)"},
    {"Numbers", "for (;;) parseFloat('1' + new Array(1e5).join('0'))"},
    {"EncodeUri", "var s = new Array(2e6).join('ą'); for (;;) encodeURIComponent(s)"},
    {"Typed", "var a = new Uint8Array(1e7); for (;;) a.set(a.subarray(1))"},
    {"TypedConversion", "var a = new Uint8Array(1e7), b = new Float32Array(1e6); for (;;) b.set(a.subarray(0, 1e6))"},
    {"Comparison", "var s = 'x'.repeat(1e7), a = s + 'a', b = s + 'b'; for (;;) a < b"},
    {"LocaleComparison", "var s = 'x'.repeat(1e7), a = s + 'a', b = s + 'b'; for (;;) a.localeCompare(b)"},
    {"CharacterAccess", "var s = 'ą'.repeat(5e6); for (var i = 0; ; i += 987654) s.charCodeAt(i % 5e6)"},
    {"SubstringAccess", "var s = 'ą'.repeat(5e6); for (var i = 0; ; i += 987654) s.substring(i % 4e6, i % 4e6 + 5)"},
    {"RegExpRanges", "var r = ''; for (var i = 300; i < 3000; i += 2) r += String.fromCharCode(i); new RegExp('^([' + "
                     "r + 'a]*)*$').test(new "
                     "Array(500).join('a') + '!')"},
    {"RegExpIgnoreCase", "/(A|a|Ą)*b/i.test(new Array(5000).join('aą'))"},
    {"NameLookup", "for (;;) ItemUtils.getClosestItemByName('x'.repeat(1e6), script)"},
    {"Warnings", "for (var i = 0; ; i++) Keyboard.getKey('key' + i)"},
    {"EnumerateString", "var s = new Array(1e6).join('x'); for (;;) for (var k in s) ;"},
    {"Keys", "var o = {}; for (var i = 0; i < 1e4; i++) o['k' + i] = i; for (;;) Object.keys(o)"},
    {"DateParse", "for (;;) new Date('2020-01-01T00:00:00Z').toISOString()"},
    {"Items", "for (;;) ItemUtils.getItemByName('none', script.parent)"},
};

// Stopped because of what they do to memory or stack.
const Evil kGreedy[] = {
    {"DeepRecursion", "(function f() { f(); })()"},
    {"DeepRecursionWithArguments", "(function f(a) { f.apply(null, [a, a, a]); })(1)"},
    {"DeepGetters", "var o = { get x() { return this.x; } }; o.x"},
    {"DeepToString", "var o = { toString: function () { return '' + o; } }; '' + o"},
    {"DeepSort", "(function f() { [2, 1].sort(f); })()"},
    {"DeepReplace", "(function f() { return 'a'.replace(/a/, f); })()"},
    {"DeepJson", "var a = []; for (var i = 0; i < 1e5; i++) a = [a]; JSON.stringify(a)"},
    {"DeepJsonParse", "JSON.parse(new Array(1e5).join('['))"},
    {"DeepSource", "eval(new Array(1e5).join('('))"},
    {"DeepRegExp", "new RegExp(new Array(1e5).join('('))"},
    {"DeepMatch", "/(?:a|b)*c/.test(new Array(1e6).join('a'))"},
    {"DeepProxy", "var p = {}; for (var i = 0; i < 1e5; i++) p = new Proxy(p, {}); p.x.y"},
    {"DoublingString", "var s = 'x'; for (;;) s += s"},
    {"DoublingArray", "var a = [1]; for (;;) a = a.concat(a)"},
    {"BigBuffer", "new Uint8Array(1e9)"},
    {"RepeatedText", "'x'.repeat(1e9)"},
    {"ManyObjects", "var a = []; for (;;) a.push({})"},
    {"ManyStrings", "var o = {}; for (var i = 0; ; i++) o['key' + i] = 'value' + i"},
    {"ManyClosures", "var a = []; for (;;) a.push(function () { return a; })"},
    {"CaughtMemory", "var a = []; for (;;) try { a.push(new Array(100)); } catch (e) {}"},
    {"LinkedList", "var l = null; for (;;) l = { next: l }"},
    {"SplitEverything", "new Array(3e7).join('ab').split('')"},
};

std::string nameOf(const testing::TestParamInfo<Evil>& info) { return info.param.name; }

}  // namespace

class ScriptLimitsTest : public ScriptTest, public testing::WithParamInterface<Evil> {
protected:
    void expectStopped(const std::string& name)
    {
        ASSERT_EQ(errors().size(), 1u) << "lines: " << printed().size();
        EXPECT_EQ(errors()[0].text.substr(0, name.size() + 10), name + ":2: error:") << errors()[0].text;
        EXPECT_EQ(errors()[0].line, 2);
    }
};

TEST_P(ScriptLimitsTest, AsAScriptItIsStoppedAndTheNextScriptRuns)
{
    script("Evil", std::string("\n") + GetParam().code);
    script("Good", "print('good');");
    const double start = processorMs();
    play();
    EXPECT_LT(processorMs() - start, 500);
    expectStopped("Evil");
    EXPECT_EQ(printed().back(), "good");
}

TEST_P(ScriptLimitsTest, AsAListenerItIsRemovedAndTheOthersGoOn)
{
    script("Evil", std::string("JetSystem.addEventListener('onStep', function () {\n") + GetParam().code + "\n});");
    script("Good",
           "var n = 0; JetSystem.addEventListener('onStep', function () { n++; if (n === 3) print('good'); });");
    play();
    const double start = processorMs();
    step();
    EXPECT_LT(processorMs() - start, 500);
    step(2);
    expectStopped("Evil");
    EXPECT_EQ(printed().back(), "good");
    EXPECT_EQ(simulation().stepCount(), 3u);
}

INSTANTIATE_TEST_SUITE_P(Endless, ScriptLimitsTest, testing::ValuesIn(kEvil), nameOf);
INSTANTIATE_TEST_SUITE_P(Greedy, ScriptLimitsTest, testing::ValuesIn(kGreedy), nameOf);

class ScriptLimitTextsTest : public ScriptTest {};

TEST_F(ScriptLimitTextsTest, MessagesSayWhichLimitAndWhatFollowed)
{
    script("Slow", "JetSystem.addEventListener('onStep', function () {\n  for (;;);\n});");
    script(
        "Fat",
        "var hoard = [];\nJetSystem.addEventListener('onStep', function () {\n  hoard.push(new Uint8Array(1e9));\n});");
    play();
    step();
    EXPECT_EQ(printed(),
              (Lines{"Slow:2: error: stopped: it ran for more than 50 ms; its onStep listener was removed",
                     "Fat:3: error: stopped: the scripts of the scene need more than 64 MB of memory; its onStep "
                     "listener was removed"}));
}

TEST_F(ScriptLimitTextsTest, AListenerCannotAddListenersWithoutEnd)
{
    script("Evil", "function add() {\n  JetSystem.addEventListener('onStep', function () { add(); });\n}\nadd();");
    script("Good", "JetSystem.addEventListener('onStep', function () { if (ctx.step === 19) print('good'); });");
    play();
    const double start = processorMs();
    step(20);
    EXPECT_LT(processorMs() - start, 500);
    ASSERT_FALSE(errors().empty());
    const std::string expected = "Evil:2: error: RangeError: addEventListener: there are 1000 onStep listeners already";
    EXPECT_EQ(errors()[0].text.substr(0, expected.size()), expected);
    EXPECT_EQ(lines(OutputLine::Kind::Text).size(), 1u);
}

// The one that is there when the memory ends is not the one that took it.
TEST_F(ScriptLimitTextsTest, TheHoarderIsStoppedNotTheInnocent)
{
    script("Innocent",
           "JetSystem.addEventListener('onStep', function () { var text = ('i' + ctx.step).repeat(4e5); });");
    script(
        "Hoarder",
        "var hoard = []; JetSystem.addEventListener('onStep', function () { hoard.push(new Uint8Array(1 << 20)); });");
    play();
    step(100);
    ASSERT_EQ(errors().size(), 1u);
    EXPECT_EQ(errors()[0].text.substr(0, 15), "Hoarder: error:") << errors()[0].text;
}

TEST_F(ScriptLimitTextsTest, MemoryThatWasFreedCanBeUsedAgain)
{
    script("Script", R"(
        JetSystem.addEventListener('onStep', function () {
            var a = [ctx.step + 'x'];
            while (a[0].length < 1e6) a[0] += a[0];
            a.push(a);  // a cycle: only a collection frees it
        });
    )");
    play();
    step(300);
    EXPECT_EQ(printed(), Lines{});
}

TEST_F(ScriptLimitTextsTest, WhatLeadsOutOfTheLimitsIsGone)
{
    body("Ball", Box({0, 0}, {10, 10}));
    EXPECT_EQ(run(R"(
        print(typeof Duktape, typeof CBOR, typeof performance, typeof Buffer, typeof String.fromBufferRaw, typeof globalThis.Duktape);
        var item = script, forged = {};
        Object.getOwnPropertyNames(item).concat(Object.getOwnPropertySymbols(item)).forEach(function (k) { forged[k] = item[k]; });
        try { ItemUtils.getTopGroup(forged); } catch (e) { print(e.name); }
        var body = script.getPriorSibling().body, liar = new Proxy({}, { get: function () { return 0; } });
        try { ItemUtils.getTopGroup(liar); } catch (e) { print(e.name); }
        ['setVelocity', 'isTouching', 'getBoundingArea'].forEach(function (f) { try { body[f].call(liar, script, 1); } catch (e) { print(e.name); } });
        var decoded = new TextDecoder().decode(new Uint8Array([0xff, 0x69, 0x74, 0x65, 0x6d]));
        print(item[decoded], item['\u00ffitem']);
    )"),
              (Lines{"undefined undefined undefined undefined undefined undefined", "TypeError", "TypeError",
                     "TypeError", "TypeError", "TypeError", "undefined undefined"}));
}

TEST_F(ScriptLimitTextsTest, LongLinesAreCut)
{
    script("Script", "print('ą'.repeat(5e5));");
    play();
    ASSERT_EQ(printed().size(), 1u);
    EXPECT_LT(printed()[0].size(), 10'100u);
    EXPECT_NE(printed()[0].find("bytes more)"), std::string::npos);
}

}  // namespace jet::test
