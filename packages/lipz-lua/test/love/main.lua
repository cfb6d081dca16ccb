--- All tests in LÖVE: `love test/love`, in `packages/lipz-lua`.

local package_folder = love.filesystem.getSource() .. "/../.."
lipz_test_package, lipz_test_root = package_folder, package_folder .. "/../.."
package.path = package_folder .. "/?.lua;" .. package_folder .. "/?/init.lua;" .. package.path

function love.load() dofile(package_folder .. "/test/run.lua") end
