//! From a tree to its equations. One algorithm, one file.

pub mod aba;
pub mod base_regressor;
pub mod centroidal;
pub mod closed;
pub mod columns;
pub mod composite;
pub mod coupling;
pub mod energy;
pub mod equations;
pub mod factor;
pub mod frames;
pub mod gauge;
pub mod lagrange;
pub mod method;
pub mod motion;
pub mod normal;
pub mod notation;
pub mod passive;
pub mod plain;
pub mod regressor;
pub mod regroup;
pub mod rest;
pub mod rnea;
pub mod rotation;
pub mod singular;
pub mod unit;
