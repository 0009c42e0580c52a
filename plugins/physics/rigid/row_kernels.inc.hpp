// Constraints of contacts that were looked at again, eight at a time: what Solver::write() does with one of them, every
// operation in the same order. Included by kernels.inc.hpp.

typedef float AnyFloat __attribute__((may_alias));

struct LaneVectors {
    Lanes<float> x, y;
};
JET_INLINE LaneVectors turned(const LaneVectors& turn, const LaneVectors& v)
{
    return {turn.x * v.x - turn.y * v.y, turn.y * v.x + turn.x * v.y};
}

/// What is frozen of eight contacts, a row of eight for each list of a group.
struct FrozenRows {
    // normal; of each point: levers, separation twice, mass, impulse; of each point: slides, mass, impulse
    alignas(32) float values[2 + 2 * 6 + 2 * 4][8];
    JET_INLINE void put(int row, const Lanes<float>& lanes) { __builtin_memcpy(values[row], &lanes, sizeof lanes); }
};

struct FrozenBodies {
    BodyLanes<float> a, b;
    Lanes<float> perGyrationA, perGyrationB;

    JET_INLINE Lanes<float> massOf(const Lanes<float>& leverA, const Lanes<float>& leverB) const
    {
        const Lanes<float> inverse = a.invMass + b.invMass + a.invMass * leverA * leverA + b.invMass * leverB * leverB;
        return choose<float>(inverse > all(0.0F), all(1.0F) / inverse, all(0.0F));
    }
};

/// One point; `there` where contacts have it.
JET_INLINE void freeze(FrozenRows& rows, int point, const FrozenBodies& bodies, const LaneVectors& n,
                       const LaneVectors& armA, const LaneVectors& armB, const Lanes<float>& separation,
                       const Lanes<float>& slop, const Lanes<float>& impulse, const Lanes<float>& tangentImpulse,
                       const Mask<float>& there)
{
    const Lanes<float> near = choose<float>(separation < 20.0F * slop, 0.5F * separation, all(0.0F));
    const LaneVectors half{near * n.x, near * n.y}, a{armA.x + half.x, armA.y + half.y},
        b{armB.x - half.x, armB.y - half.y};
    const Lanes<float> leverA = (a.x * n.y - a.y * n.x) * bodies.perGyrationA,
                       leverB = (b.x * n.y - b.y * n.x) * bodies.perGyrationB;
    const Lanes<float> slideA = (a.x * n.x + a.y * n.y) * bodies.perGyrationA,
                       slideB = (b.x * n.x + b.y * n.y) * bodies.perGyrationB;
    const auto put = [&](int row, const Lanes<float>& lanes)
                         JET_INLINED { rows.put(row, choose<float>(there, lanes, all(0.0F))); };
    const int normals = 2 + 6 * point, slides = 2 + 2 * 6 + 4 * point;
    put(normals, leverA), put(normals + 1, leverB), put(normals + 2, separation + slop);
    put(normals + 3, separation + slop), put(normals + 4, bodies.massOf(leverA, leverB)), put(normals + 5, impulse);
    put(slides, slideA), put(slides + 1, slideB), put(slides + 2, bodies.massOf(slideA, slideB));
    put(slides + 3, tangentImpulse);
}

/// From the rows to the lanes.
JET_INLINE void spread(const FrozenRows& rows, const LaneOfContact& to, int i)
{
    static_assert(offsetof(ContactLanes<float>, points) == offsetof(ContactLanes<float>, normalX) + 3 * 32);
    static_assert(sizeof(ContactLanes<float>::Point) == 6 * 32 && sizeof(FrictionLanes<float>::Point) == 5 * 32);
    const auto lanesFrom = [&](auto& first) JET_INLINED { return reinterpret_cast<AnyFloat*>(&first) + to.lane; };
    AnyFloat *const normal = lanesFrom(to.group->normalX), *const points = lanesFrom(to.group->points),
                    *const friction = lanesFrom(to.friction->friction),
                    *const first = lanesFrom(to.friction->points[0]), *const second = lanesFrom(to.friction->points[1]);
    const RigidContact& c = *to.contact;
    friction[0] = c.friction;
    if (c.count < 2) second[4 * 8] = 0;
    for (int row = 0; row < 2; ++row) normal[8 * row] = rows.values[row][i];
    for (int row = 0; row < 12; ++row) points[8 * row] = rows.values[2 + row][i];
    for (int row = 0; row < 4; ++row) first[8 * row] = rows.values[14 + row][i];
    for (int row = 0; row < 4; ++row) second[8 * row] = rows.values[18 + row][i];
}

void writeContacts(const LaneOfContact* eight, const Pose* poses, const BodyState<float>* states)
{
    const auto of = [&](auto member) JET_INLINED {
        return [=](int i) JET_INLINED { return reinterpret_cast<const float*>(&(eight[i].contact->*member)); };
    };
    alignas(32) std::int32_t a[8], b[8];
    alignas(32) float counts[8];
    for (int i = 0; i < 8; ++i) {
        a[i] = eight[i].group->a[eight[i].lane], b[i] = eight[i].group->b[eight[i].lane];
        counts[i] = eight[i].contact->count;
    }
    FrozenBodies bodies{velocities(states, a), velocities(states, b), {}, {}};
    bodies.perGyrationA = moves(states, a).perGyration, bodies.perGyrationB = moves(states, b).perGyration;
    LaneVectors turnA, turnB, normal, onA[2], onB[2];
    Lanes<float> slop, separation[2], impulse[2], tangent[2], ignored, more;
    gatherRows([&](int i) JET_INLINED { return &poses[eight[i].contact->bodyA].turn.x; }, turnA.x, turnA.y, ignored,
               more);
    gatherRows([&](int i) JET_INLINED { return &poses[eight[i].contact->bodyB].turn.x; }, turnB.x, turnB.y, ignored,
               more);
    gatherRows(of(&RigidContact::slop), slop, separation[0], separation[1], ignored);
    gatherRows(of(&RigidContact::normal), normal.x, normal.y, onA[0].x, onA[0].y);
    gatherRows([&](int i) JET_INLINED { return &eight[i].contact->onA[1].x; }, onA[1].x, onA[1].y, onB[0].x, onB[0].y);
    gatherRows([&](int i) JET_INLINED { return &eight[i].contact->onB[1].x; }, onB[1].x, onB[1].y, impulse[0],
               impulse[1]);
    gatherRows(of(&RigidContact::tangentImpulse), tangent[0], tangent[1], ignored, more);
    Lanes<float> count;
    __builtin_memcpy(&count, counts, sizeof count);
    const LaneVectors n = turned(turnA, normal);
    FrozenRows rows;
    rows.put(0, n.x), rows.put(1, n.y);
    for (int k = 0; k < 2; ++k)
        freeze(rows, k, bodies, n, turned(turnA, onA[k]), turned(turnB, onB[k]), separation[k], slop, impulse[k],
               tangent[k], count > all(static_cast<float>(k)));
    for (int i = 0; i < 8; ++i) spread(rows, eight[i], i);
}
