//! What cannot be drawn.

use proptest::prelude::*;
use riemap::figure::{Camera, Checker, FigureError, Shading, SurfaceView};
use riemap::surface::Faces;

use super::shared::{Point, Sheet, draw};

#[test]
fn what_cannot_be_drawn_is_named() {
    let sheet = Sheet::new(2, 4.0, false, |_, _| 0.0);
    let view = sheet.view();
    let size = [400, 400];
    let message = |view: SurfaceView| view.render(size).unwrap_err().to_string();

    assert!(matches!(view.render([70, 70]), Err(FigureError::Room { .. })));
    assert!(matches!(
        SurfaceView { uv: &sheet.uv[1..], ..view }.render(size),
        Err(FigureError::TextureCount { given: 15, corners: 16 })
    ));
    assert!(matches!(
        SurfaceView { shading: Shading::Normals(&[[0.0; 3]]), ..view }.render(size),
        Err(FigureError::NormalCount { normals: 1, faces: 4 })
    ));
    assert!(matches!(
        SurfaceView { marked: &[4], ..view }.render(size),
        Err(FigureError::Marked { face: 4, faces: 4 })
    ));
    assert!(matches!(
        SurfaceView { seams: &[[0, 9]], ..view }.render(size),
        Err(FigureError::Seam { seam: 0, vertex: 9 })
    ));
    assert!(matches!(
        SurfaceView { positions: &sheet.positions[..8], ..view }.render(size),
        Err(FigureError::Vertex { face: 3, vertex: 8, points: 8 })
    ));
    let mut uv = sheet.uv.clone();
    uv[5][1] = f64::NAN;
    assert!(message(SurfaceView { uv: &uv, ..view }).contains("face 1"));
    for (value, word) in [(f64::NAN, "vertex 4"), (f64::INFINITY, "vertex 4"), (1e200, "too large")] {
        let mut positions = sheet.positions.clone();
        positions[4][2] = value;
        let message = message(SurfaceView { positions: &positions, ..view });
        assert!(message.contains(word), "{message}");
    }
    let points = [[1.0, 2.0, 3.0]; 9];
    assert!(matches!(
        SurfaceView { positions: &points, ..view }.render(size),
        Err(FigureError::NoSurfaceExtent { at: [1.0, 2.0, 3.0] })
    ));
    assert!(matches!(SurfaceView::new(&[], &Faces::default(), &[]).render(size), Err(FigureError::NoFaces)));
    for camera in [
        Camera { towards: Some([0.0; 3]), ..Camera::default() },
        Camera { towards: Some([f64::NAN, 0.0, 1.0]), ..Camera::default() },
        Camera::with_up([0.0; 3]),
        Camera { field_of_view: 170.0, ..Camera::default() },
        Camera { field_of_view: f64::NAN, ..Camera::default() },
    ] {
        let message = message(SurfaceView { camera, ..view });
        assert!(message.starts_with("the camera's"), "{message}");
    }
    assert!(matches!(Checker::across([[0.0; 2]], 8), Err(FigureError::Squares { squares: 8, .. })));
    assert!(matches!(Checker::across([[0.0; 2], [1.0; 2]], 0), Err(FigureError::Squares { squares: 0, .. })));
}

#[test]
fn faces_of_no_area_and_of_few_corners_are_drawn_or_passed_over() {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.0, 0.0]];
    let faces: Faces = [&[0u32, 1, 2, 3][..], &[0, 4, 1], &[2, 2, 2], &[3, 3, 3, 3], &[0, 2], &[1], &[0, 1, 2, 3, 4]]
        .into_iter()
        .collect();
    let uv = vec![[0.5; 2]; faces.corners().len()];
    draw(&SurfaceView::new(&positions, &faces, &uv), [300, 300]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn whatever_is_finite_is_drawn_or_refused(
        coordinates in prop::collection::vec(prop::array::uniform3(-1e3..1e3f64), 8),
        corners in prop::collection::vec(prop::collection::vec(0u32..8, 1..6), 1..8),
        exponent in -320i32..320,
        towards in prop::array::uniform3(-1.0..1.0f64),
    ) {
        let factor = 10f64.powi(exponent);
        let positions: Vec<Point> = coordinates.iter().map(|p| p.map(|x| x * factor)).collect();
        let faces: Faces = corners.iter().collect();
        let uv: Vec<[f64; 2]> = faces.corners().iter().map(|v| [f64::from(*v) * factor, f64::from(*v)]).collect();
        let camera = Camera { towards: Some(towards), ..Camera::default() };
        let result = SurfaceView { camera, edges: true, ..SurfaceView::new(&positions, &faces, &uv) }.render([150, 150]);
        if let Err(error) = result {
            prop_assert!(!error.to_string().contains("NaN") || exponent > 100, "{}", error);
        }
    }
}
