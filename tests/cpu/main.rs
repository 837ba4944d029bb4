//! Do the parts that need no GPU do what they say?

mod beckmann;
mod bench_record;
mod bench_report;
mod constants;
mod cook_torrance;
mod coordinates;
mod coupled;
mod crease_normals;
mod effects;
mod given;
mod hemisphere;
mod layout;
mod maps;
mod material_library;
mod mtl;
mod mutation;
mod obj;
mod optimised;
mod oren_nayar;
mod phong;
mod punctual;
mod quadrature;
mod sample_textures;
mod samples;
mod scene_file;
mod scene_override;
mod schlick;
mod shade;
mod shader_build;
#[path = "../../src/shader_build/mod.rs"]
mod shader_builder;
mod shapes;
mod stability_report;
mod statistics;
mod textures;
mod tidy;
#[path = "../tolerances.rs"]
mod tolerances;
mod v_cavity;
mod wall;
