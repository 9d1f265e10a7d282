//! Estimated normals.
