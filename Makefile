# What does one type to see Umber draw, and to see it tested?
#
#   make demo              renders the material zoo to out/zoo.png
#   make test              runs all tests on lavapipe
#   make test-swiftshader  runs the GPU tests on the second CPU driver
#   make check             formatting and clippy
#
# On Debian what is missing is installed first; elsewhere the line that installs it is printed.

.PHONY: demo test test-swiftshader check
.DEFAULT_GOAL := demo

CARGO := .ci/as-user cargo
# Older loaders read the second name, newer ones the first.
ON = .ci/as-user env VK_DRIVER_FILES="$$icd" VK_ICD_FILENAMES="$$icd"

demo:
	@.ci/need c++ driver
	$(CARGO) build --release --locked
	@# A driver whose device is not there is none.
	@.ci/as-user target/release/umber devices >/dev/null 2>&1 || .ci/need lavapipe
	.ci/as-user mkdir -p out
	.ci/as-user target/release/umber render scenes/zoo.toml --output out/zoo.png
	@echo "demo: built target/release/umber and rendered scenes/zoo.toml to out/zoo.png"

test:
	@.ci/need c++ lavapipe layers spirv-opt
	@icd=$$(.ci/need --manifest lavapipe) && echo "test: on the driver of $$icd" && \
	$(ON) cargo run --quiet --locked -- devices && \
	$(ON) cargo test --locked

test-swiftshader:
	@.ci/need c++ swiftshader layers
	@icd=$$(.ci/need --manifest swiftshader) && echo "test: on the driver of $$icd" && \
	$(ON) cargo run --quiet --locked -- devices && \
	$(ON) cargo test --locked --test gpu

check:
	@.ci/need c++
	$(CARGO) fmt --check
	$(CARGO) clippy --locked --all-targets -- -D warnings
