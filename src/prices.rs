//! Prices, in sixteenths of a cycle of a core without wait states: made by `cargo xtask cost --calibrate`.

use crate::{price::Price, work::Work};

/// In the order of the counts of [`Work`].
impl Price {
    /// Cycles of a Cortex-M0+ for [`DuffBarycentric`](crate::DuffBarycentric).
    pub const M0_PLUS_DUFF_BARYCENTRIC: Self = Self(Work::of([
        9731, 3907, 2169, 5376, 0, 19408, 17598, 0, 628, 7889, 0, 5804, 18590, 59452, 990, 33583, 0, 2244, 13672, 2108, 38, 774,
        3262, 3494, 240, 1933, 1007, 2155,
    ]));

    /// Cycles of a Cortex-M0+ for [`QuadraticIntensity`](crate::QuadraticIntensity).
    pub const M0_PLUS_QUADRATIC_INTENSITY: Self = Self(Work::of([
        9731, 3817, 2169, 5376, 0, 19408, 17688, 0, 628, 8081, 0, 5814, 18597, 57601, 1243, 42955, 0, 2297, 13672, 2141, 38, 160,
        2552, 1631, 367, 1115, 0, 0,
    ]));

    /// Cycles of a Cortex-M0+ for [`Gouraud`](crate::Gouraud).
    pub const M0_PLUS_GOURAUD: Self = Self(Work::of([
        9731, 5556, 0, 5376, 2169, 16845, 17580, 0, 726, 7569, 0, 6119, 18619, 59516, 0, 17323, 0, 2648, 13759, 1894, 38, 5,
        2028, 1484, 858, 0, 0, 0,
    ]));

    /// Cycles of a Cortex-M0+ for [`Flat`](crate::Flat).
    pub const M0_PLUS_FLAT: Self = Self(Work::of([
        9713, 3567, 2169, 5376, 0, 19408, 17795, 0, 628, 7478, 0, 6119, 18316, 59058, 0, 11396, 0, 2343, 13724, 2130, 38, 97,
        1004, 1573, 544, 0, 0, 0,
    ]));

    /// The same for each rung of [`Degrading`](crate::Degrading).
    pub const M0_PLUS_DEGRADING: [Self; 4] = [
        Self(Work::of([
            9731, 6541, 0, 5376, 2169, 17240, 17508, 0, 628, 7608, 0, 5836, 17646, 57882, 717, 35661, 699, 2171, 13672, 2181, 38,
            414, 3940, 4150, 236, 1862, 1013, 2110,
        ])),
        Self(Work::of([
            9731, 6541, 0, 5376, 2169, 17240, 17508, 0, 628, 7914, 0, 5716, 17553, 57936, 1311, 48892, 407, 2269, 13672, 2083,
            38, 148, 3609, 3337, 275, 1135, 0, 0,
        ])),
        Self(Work::of([
            9731, 6541, 0, 5376, 2169, 17240, 17508, 0, 628, 7581, 0, 5989, 17583, 58144, 1107, 24920, 402, 2345, 13672, 2007,
            38, 0, 2891, 3323, 919, 0, 0, 0,
        ])),
        Self(Work::of([
            9731, 6541, 0, 5376, 2169, 17240, 17508, 0, 628, 7581, 0, 6012, 17571, 58016, 1097, 20507, 135, 2273, 13672, 2079,
            38, 0, 2261, 4024, 177, 0, 0, 0,
        ])),
    ];

    /// Cycles of a Cortex-M4 for [`DuffBarycentric`](crate::DuffBarycentric).
    pub const M4_DUFF_BARYCENTRIC: Self = Self(Work::of([
        7258, 5448, 0, 3817, 1488, 11864, 2547, 0, 628, 5842, 0, 3914, 7926, 19103, 781, 21952, 0, 1970, 1314, 1919, 20, 674,
        2462, 2886, 159, 1104, 500, 1778,
    ]));

    /// Cycles of a Cortex-M4 for [`QuadraticIntensity`](crate::QuadraticIntensity).
    pub const M4_QUADRATIC_INTENSITY: Self = Self(Work::of([
        7258, 3704, 1548, 3877, 0, 13231, 1983, 0, 687, 6009, 0, 3864, 8027, 19056, 21, 29628, 0, 2525, 1262, 1588, 20, 57, 2343,
        1348, 206, 802, 0, 0,
    ]));

    /// Cycles of a Cortex-M4 for [`Gouraud`](crate::Gouraud).
    pub const M4_GOURAUD: Self = Self(Work::of([
        7240, 5144, 0, 3919, 1589, 11559, 3469, 0, 729, 5711, 0, 4041, 8011, 19191, 0, 11529, 0, 2254, 1279, 1549, 20, 181, 1625,
        1206, 548, 0, 0, 0,
    ]));

    /// Cycles of a Cortex-M4 for [`Flat`](crate::Flat).
    pub const M4_FLAT: Self = Self(Work::of([
        7240, 5188, 0, 3880, 1551, 11675, 3408, 0, 690, 5707, 0, 4041, 7988, 19211, 0, 6299, 0, 2149, 1279, 1843, 20, 135, 865,
        1047, 472, 0, 0, 0,
    ]));

    /// The same for each rung of [`Degrading`](crate::Degrading).
    pub const M4_DEGRADING: [Self; 4] = [
        Self(Work::of([
            7330, 5838, 0, 3855, 1525, 11966, 3062, 0, 593, 5917, 0, 3865, 7658, 18896, 662, 27412, 45, 2043, 1314, 1846, 20,
            639, 3180, 3624, 160, 1097, 499, 1778,
        ])),
        Self(Work::of([
            7330, 5842, 0, 3853, 1524, 11971, 2434, 0, 592, 5914, 0, 3793, 7692, 18897, 962, 36665, 0, 1992, 1314, 1897, 20, 19,
            2840, 3104, 185, 784, 0, 0,
        ])),
        Self(Work::of([
            7330, 3889, 1631, 3961, 0, 13279, 3683, 0, 699, 6129, 0, 3956, 7771, 18790, 721, 18966, 114, 2090, 1314, 1799, 20, 0,
            2226, 3030, 591, 0, 0, 0,
        ])),
        Self(Work::of([
            7330, 5520, 0, 3961, 1631, 11648, 3690, 0, 699, 6129, 0, 3962, 7768, 18790, 830, 14027, 107, 2080, 1495, 1809, 20, 0,
            1879, 3354, 143, 0, 0, 0,
        ])),
    ];
}
