#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes three.js, the part of the library three (https://threejs.org) that pages draw with, in one file without
# imports. For a release: who builds the programs takes the file as it is, and needs neither network nor npm.

set -euo pipefail

THREE=0.187.0 ESBUILD=0.28.2

folder=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
echo '{"private": true}' > package.json
npm install --no-audit --no-fund "three@$THREE" "esbuild@$ESBUILD"
cat > entry.js << 'END'
export {
  AmbientLight, BufferAttribute, BufferGeometry, ColorManagement, DirectionalLight, DoubleSide, LineBasicMaterial,
  LineSegments, LinearSRGBColorSpace, Mesh, MeshLambertMaterial, OrthographicCamera, Raycaster, Scene, Vector2,
  Vector3, WebGLRenderer
} from "three";
export { OrbitControls } from "three/addons/controls/OrbitControls.js";
END
{
  echo "/*! three.js $THREE, https://threejs.org"
  echo
  cat node_modules/three/LICENSE
  echo "*/"
} > banner.txt
npx esbuild entry.js --bundle --minify --format=iife --global-name=THREE --charset=ascii --legal-comments=none \
  --banner:js="$(cat banner.txt)" --outfile="$folder/three.js"
