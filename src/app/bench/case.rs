//! The tables of meshes and of contestants.

/// Kinds of maps. Only maps of one kind are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MapClass {
    /// The boundary is on a circle.
    Circle,
    /// The boundary is free, and only angles are preserved.
    Free,
    /// The boundary is free, and lengths and areas are preserved, too.
    Isometric,
}

impl MapClass {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            MapClass::Circle => "circle",
            MapClass::Free => "free",
            MapClass::Isometric => "isometric",
        }
    }
}

/// Sources of meshes.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// A generated surface; `{n}` stands for the number of vertices along a side.
    Generated(&'static str),
    /// Triangles around one vertex, as many as there are vertices on the rim.
    Fan,
    /// A public file.
    File(&'static str),
}

/// A mesh of any size, or a file.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Its name on the command line.
    pub name: &'static str,
    /// Its description, in one line.
    pub about: &'static str,
    /// The source of its meshes.
    pub source: Source,
    /// Largest number of vertices.
    pub largest: usize,
    /// Largest number of vertices for slow contestants.
    pub slow_up_to: usize,
    /// Largest number of vertices for isometric maps.
    pub isometric_up_to: usize,
}

impl Case {
    /// Returns the mesh of about `vertices` vertices; `None` if the case has none of that size.
    pub fn mesh(&self, vertices: usize) -> Option<String> {
        match self.source {
            Source::Generated(pattern) if vertices <= self.largest => {
                let side = (vertices as f64).sqrt().round().max(4.0);
                Some(pattern.replace("{n}", &side.to_string()))
            }
            Source::Fan if vertices <= self.largest => Some(format!("a fan of {vertices} triangles")),
            _ => None,
        }
    }
}

/// All cases.
pub static CASES: &[Case] = &[
    Case {
        name: "grid",
        about: "quads, a regular grid on the egg box z = cos s + cos t",
        source: Source::Generated("graph:cos+cos?n={n}"),
        largest: usize::MAX,
        slow_up_to: usize::MAX,
        isometric_up_to: usize::MAX,
    },
    Case {
        name: "jittered",
        about: "quads, the same grid with its vertices displaced",
        source: Source::Generated("graph:cos+cos?n={n}&jitter=0.3&seed=1"),
        largest: usize::MAX,
        slow_up_to: 10_000,
        isometric_up_to: 0,
    },
    Case {
        name: "split",
        about: "triangles, the grid's quads split along alternating diagonals",
        source: Source::Generated("graph:cos+cos?n={n}&mesh=triangle"),
        largest: 100_000,
        slow_up_to: 10_000,
        isometric_up_to: 0,
    },
    Case {
        name: "delaunay",
        about: "triangles, Delaunay, vertices at random places and in random order",
        source: Source::Generated("graph:cos+cos?n={n}&mesh=delaunay&points=random&seed=1"),
        largest: usize::MAX,
        slow_up_to: 100_000,
        isometric_up_to: 100_000,
    },
    Case {
        name: "fan",
        about: "triangles, a flat cone: all of them around one vertex",
        source: Source::Fan,
        largest: 100_000,
        slow_up_to: 0,
        isometric_up_to: 0,
    },
    Case {
        name: "bff-face",
        about: "triangles, a scanned face (public file tri/bff-face.obj)",
        source: Source::File("tri/bff-face.obj"),
        largest: usize::MAX,
        slow_up_to: usize::MAX,
        isometric_up_to: 0,
    },
];

/// A program with one of its methods.
#[derive(Clone, Copy, Debug)]
pub struct Contestant {
    /// Its name in tables.
    pub name: &'static str,
    /// Its description, in one line.
    pub about: &'static str,
    /// Kind of its maps.
    pub kind: MapClass,
    /// The program that runs.
    pub program: Program,
    /// Largest number of vertices.
    pub largest: usize,
    /// Whether it is slow, and does not run on the large meshes of some cases.
    pub slow: bool,
}

/// Programs that run.
#[derive(Clone, Copy, Debug)]
pub enum Program {
    /// This program: `riemap map` with these options.
    Riemap(&'static [&'static str]),
    /// A function of `peers.py`, which needs these packages.
    Peer(&'static [Package]),
    /// The program of Boundary First Flattening with these options.
    Bff(&'static [&'static str]),
}

/// A Python package.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Package {
    /// Its name at PyPI.
    pub name: &'static str,
    /// How to install it.
    pub install: &'static str,
}

const LIBIGL: Package = Package { name: "libigl", install: "pip install libigl==2.6.3 numpy scipy" };
const MESHLAB: Package = Package { name: "pymeshlab", install: "pip install pymeshlab==2025.7.post1" };
const CHOLMOD: Package = Package {
    name: "scikit-sparse",
    install: "apt-get install libsuitesparse-dev libopenblas-dev gcc, then riemap bench --build-scikit-sparse, or in an \
              interpreter of your own pip install --no-build-isolation scikit-sparse==0.4.16",
};

/// All contestants; the first of each kind is ours.
pub static CONTESTANTS: &[Contestant] = &[
    Contestant {
        name: "riemap-circle",
        about: "H + C, nonlinear: the boundary slides on the circle, three points held",
        kind: MapClass::Circle,
        program: Program::Riemap(&["--boundary", "circle", "--valid", "off"]),
        largest: usize::MAX,
        slow: false,
    },
    Contestant {
        name: "cholmod-harmonic",
        about: "cotan Laplacian by numpy, boundary held by arc length, SuiteSparse's Cholesky; the assembly is told apart",
        kind: MapClass::Circle,
        program: Program::Peer(&[LIBIGL, CHOLMOD]),
        largest: usize::MAX,
        slow: false,
    },
    Contestant {
        name: "libigl-harmonic",
        about: "igl.harmonic, boundary held by arc length; the whole function, assembly included",
        kind: MapClass::Circle,
        program: Program::Peer(&[LIBIGL]),
        largest: usize::MAX,
        slow: false,
    },
    Contestant {
        name: "meshlab-harmonic",
        about: "MeshLab's harmonic parametrisation",
        kind: MapClass::Circle,
        program: Program::Peer(&[MESHLAB]),
        largest: 100_000,
        slow: true,
    },
    Contestant {
        name: "bff-disc",
        about: "Boundary First Flattening onto the disc, the whole program",
        kind: MapClass::Circle,
        program: Program::Bff(&["--flattenToDisk"]),
        largest: usize::MAX,
        slow: true,
    },
    Contestant {
        name: "riemap-free",
        about: "H + L', nonlinear: the boundary keeps its lengths",
        kind: MapClass::Free,
        program: Program::Riemap(&["--boundary", "free", "--valid", "off"]),
        largest: usize::MAX,
        slow: false,
    },
    Contestant {
        name: "libigl-lscm",
        about: "igl.lscm, two boundary vertices held; the whole function, assembly included",
        kind: MapClass::Free,
        program: Program::Peer(&[LIBIGL]),
        largest: usize::MAX,
        slow: true,
    },
    Contestant {
        name: "meshlab-lscm",
        about: "MeshLab's least-squares conformal map",
        kind: MapClass::Free,
        program: Program::Peer(&[MESHLAB]),
        largest: 100_000,
        slow: true,
    },
    Contestant {
        name: "bff-free",
        about: "Boundary First Flattening of least area distortion, the whole program",
        kind: MapClass::Free,
        program: Program::Bff(&[]),
        largest: usize::MAX,
        slow: true,
    },
    Contestant {
        name: "riemap-sd",
        about: "the symmetric Dirichlet energy, to its minimum",
        kind: MapClass::Isometric,
        program: Program::Riemap(&["--energy", "SD"]),
        largest: 100_000,
        slow: true,
    },
    Contestant {
        name: "riemap-isometric",
        about: "H + A + L, to its minimum",
        kind: MapClass::Isometric,
        program: Program::Riemap(&["--energy", "H + A + L"]),
        largest: 100_000,
        slow: true,
    },
    Contestant {
        name: "libigl-slim",
        about: "igl.slim_solve, symmetric Dirichlet, 20 iterations from the harmonic map",
        kind: MapClass::Isometric,
        program: Program::Peer(&[LIBIGL]),
        largest: 100_000,
        slow: true,
    },
    Contestant {
        name: "libigl-arap",
        about: "igl.arap_solve in the plane, 20 iterations from the harmonic map",
        kind: MapClass::Isometric,
        program: Program::Peer(&[LIBIGL]),
        largest: 100_000,
        slow: true,
    },
];

impl Contestant {
    /// Whether it runs on a mesh of `vertices` vertices.
    pub fn enters(&self, case: &Case, vertices: usize) -> bool {
        // A size is what was asked for; a grid has a few vertices more or fewer.
        let beyond = |limit: usize| vertices as f64 > 1.1 * limit as f64;
        let all = beyond(self.largest);
        let slow = self.slow && beyond(case.slow_up_to);
        let isometric = self.kind == MapClass::Isometric && beyond(case.isometric_up_to);
        !(all || slow || isometric)
    }

    /// Whether it is this program.
    pub fn is_ours(&self) -> bool {
        matches!(self.program, Program::Riemap(_))
    }
}

/// Returns the case of that name.
pub fn case(name: &str) -> Option<&'static Case> {
    CASES.iter().find(|case| case.name == name)
}
