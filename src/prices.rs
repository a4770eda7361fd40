//! Prices, in sixteenths of a cycle of a core without wait states: made by `cargo xtask cost --calibrate`.

use crate::{price::Price, work::Work};

/// In the order of the counts of [`Work`].
impl Price {
    /// Cycles of a Cortex-M0+ for [`DuffBarycentric`](crate::DuffBarycentric).
    pub const M0_PLUS_DUFF_BARYCENTRIC: Self = Self(Work::of([
        9821, 5627, 2330, 7079, 0, 28762, 13208, 0, 377, 7823, 0, 7974, 17767, 59315, 1713, 33708, 0, 2136, 13792, 2458, 38, 916,
        2948, 3779, 250, 2057, 887, 2059,
    ]));

    /// Cycles of a Cortex-M0+ for [`QuadraticIntensity`](crate::QuadraticIntensity).
    pub const M0_PLUS_QUADRATIC_INTENSITY: Self = Self(Work::of([
        9856, 5126, 2330, 7079, 0, 28941, 13566, 0, 377, 8122, 0, 7930, 17926, 59285, 1163, 43152, 0, 2634, 13845, 2118, 38, 0,
        3012, 1718, 382, 1200, 0, 0,
    ]));

    /// Cycles of a Cortex-M0+ for [`Gouraud`](crate::Gouraud).
    pub const M0_PLUS_GOURAUD: Self = Self(Work::of([
        9767, 4821, 2330, 7133, 0, 28995, 13996, 0, 431, 7840, 0, 8274, 17143, 59917, 455, 18924, 0, 2734, 13845, 1982, 38, 0,
        2071, 1445, 966, 0, 0, 0,
    ]));

    /// Cycles of a Cortex-M0+ for [`Flat`](crate::Flat).
    pub const M0_PLUS_FLAT: Self = Self(Work::of([
        9767, 4283, 2456, 7258, 0, 28950, 14409, 0, 556, 7897, 0, 8342, 17305, 59602, 0, 12201, 0, 2569, 13845, 2147, 38, 0,
        1129, 1685, 549, 0, 0, 0,
    ]));

    /// The same for each rung of [`Degrading`](crate::Degrading).
    pub const M0_PLUS_DEGRADING: [Self; 4] = [
        Self(Work::of([
            9821, 7867, 0, 7079, 2330, 26468, 13279, 0, 377, 7714, 0, 8065, 17068, 58588, 1201, 36533, 544, 2569, 13792, 2025,
            38, 698, 3960, 4436, 253, 1981, 910, 2060,
        ])),
        Self(Work::of([
            9821, 5538, 2330, 7079, 0, 28798, 13279, 0, 377, 8019, 0, 7945, 16739, 58429, 1776, 49466, 359, 2455, 13792, 2139,
            38, 120, 3643, 3723, 274, 1099, 0, 0,
        ])),
        Self(Work::of([
            9821, 5376, 2330, 7133, 0, 28717, 13440, 0, 431, 7655, 0, 8224, 16890, 59036, 1676, 27008, 231, 2517, 13792, 2076,
            38, 0, 2808, 3647, 934, 0, 0, 0,
        ])),
        Self(Work::of([
            9821, 5376, 2330, 7133, 0, 28717, 14419, 0, 431, 7600, 0, 8261, 16899, 58740, 1482, 21663, 75, 2234, 13792, 2359, 38,
            0, 2347, 4360, 172, 0, 0, 0,
        ])),
    ];

    /// Cycles of a Cortex-M4 for [`DuffBarycentric`](crate::DuffBarycentric).
    pub const M4_DUFF_BARYCENTRIC: Self = Self(Work::of([
        7258, 5968, 0, 4767, 1488, 17795, 1103, 0, 484, 5305, 0, 5928, 7650, 19708, 494, 20824, 0, 2057, 1279, 2057, 21, 464,
        2790, 3055, 159, 1019, 351, 1865,
    ]));

    /// Cycles of a Cortex-M4 for [`QuadraticIntensity`](crate::QuadraticIntensity).
    pub const M4_QUADRATIC_INTENSITY: Self = Self(Work::of([
        7258, 5986, 0, 4773, 1488, 17777, 1034, 0, 490, 5472, 0, 5830, 7672, 19624, 460, 29040, 0, 2292, 1347, 1751, 21, 0, 2171,
        1269, 225, 718, 0, 0,
    ]));

    /// Cycles of a Cortex-M4 for [`Gouraud`](crate::Gouraud).
    pub const M4_GOURAUD: Self = Self(Work::of([
        7240, 6223, 0, 4682, 1488, 18050, 1489, 0, 399, 4915, 0, 5967, 7498, 19916, 0, 12186, 0, 2332, 1279, 1605, 21, 115, 1602,
        1248, 522, 0, 0, 0,
    ]));

    /// Cycles of a Cortex-M4 for [`Flat`](crate::Flat).
    pub const M4_FLAT: Self = Self(Work::of([
        7240, 6232, 0, 4673, 1488, 18077, 1529, 0, 390, 5354, 0, 5946, 7504, 19706, 0, 8011, 0, 2103, 1303, 1835, 21, 236, 740,
        1167, 446, 0, 0, 0,
    ]));

    /// The same for each rung of [`Degrading`](crate::Degrading).
    pub const M4_DEGRADING: [Self; 4] = [
        Self(Work::of([
            7258, 5950, 0, 4809, 1488, 17670, 1537, 0, 526, 5347, 0, 5936, 7655, 19651, 312, 26803, 0, 2215, 1279, 1898, 21, 356,
            3655, 3847, 160, 994, 359, 1865,
        ])),
        Self(Work::of([
            7258, 4830, 1488, 4686, 0, 19525, 868, 0, 404, 5349, 0, 5807, 7536, 19650, 768, 36413, 0, 2336, 1296, 1777, 21, 0,
            2925, 3356, 185, 685, 0, 0,
        ])),
        Self(Work::of([
            7258, 4463, 1488, 4809, 0, 19157, 1592, 0, 526, 5472, 0, 5956, 7645, 19589, 591, 19581, 114, 2396, 1279, 1717, 21, 0,
            2712, 3315, 554, 0, 0, 0,
        ])),
        Self(Work::of([
            7258, 5950, 0, 4809, 1488, 17670, 1871, 0, 526, 5472, 0, 5969, 7638, 19589, 565, 15329, 30, 2563, 1315, 1551, 21, 0,
            2491, 3537, 135, 0, 0, 0,
        ])),
    ];
}
