//! The letters of a lecture beside those of the robot: no letter has two meanings on one page.

use dynamics_codegen::mechanics::letters::{Letter, Letters, told};

use super::document::{Block, Math, Piece, Side, math, words};

/// Lets the letters of the lecture give way to the robot's own, and says behind the first words which did.
pub(super) fn settle(blocks: &mut Vec<Block>, letters: &Letters) {
    let mut given_way: Vec<&'static Letter> = Vec::new();
    let mut settle = |math: &mut Math| {
        for letter in letters.given_way(&math.unicode) {
            if !given_way.iter().any(|known| std::ptr::eq(*known, letter)) {
                given_way.push(letter);
            }
        }
        *math = self::math(letters.unicode(&math.unicode), letters.latex(&math.latex));
    };
    for block in blocks.iter_mut() {
        match block {
            Block::Title(pieces) | Block::Text(pieces) => of_pieces(pieces, &mut settle),
            Block::List(items) => items.iter_mut().for_each(|item| of_pieces(item, &mut settle)),
            Block::Equation(sides) => {
                for side in sides {
                    if let Side::Math(math) = side {
                        settle(math);
                    }
                }
            }
            Block::Heading(_) => {}
        }
    }
    if !given_way.is_empty() {
        let first = blocks.iter().position(|block| matches!(block, Block::Text(_))).map_or(0, |at| at + 1);
        let told = told(&given_way, |letter| format!("${}|{}$", letter.unicode, letter.latex));
        blocks.insert(first, Block::Text(words(&told)));
    }
}

fn of_pieces(pieces: &mut [Piece], settle: &mut impl FnMut(&mut Math)) {
    for piece in pieces {
        if let Piece::Math(math) = piece {
            settle(math);
        }
    }
}
